// SPDX-License-Identifier: BSL-1.0
// The noise that measure_noise finds, against the noise that was simulated: over all points, and
// over points of similar range or depth. Scans with little that is flat have no answer.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "../chapter4/record.hpp"
#include "furnished.hpp"

namespace {

/// The relative errors of a curve of the noise: the root of the mean ratio of variances, minus 1.
struct curve_error {
    double overall = 0.0;
    double of_bin = 0.0;  ///< the largest over bins of half a meter with 1 % of the points
};

/// @param x_of         the true range or depth of a point [m]
/// @param variance_of  the true variance along the ray of a point [m^2]
curve_error error_of(const gnomon::noise_curve& curve, const sim::true_scan& truth, auto&& x_of,
                     auto&& variance_of) {
    struct mean {
        double sum = 0.0;
        std::size_t points = 0;
        [[nodiscard]] double error() const {
            return std::abs(std::sqrt(sum / static_cast<double>(points)) - 1.0);
        }
    };
    constexpr double width = 0.5;
    mean all;
    std::map<int, mean> bins;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d ray = truth.scan.points[i] - truth.scan.viewpoints[i];
        const double ratio = curve.variance_along(ray) / variance_of(i);
        for (mean* m : {&all, &bins[static_cast<int>(x_of(i) / width)]}) {
            m->sum += ratio;
            ++m->points;
        }
    }
    curve_error result{all.error(), 0.0};
    for (const auto& [bin, m] : bins)
        if (100 * m.points >= truth.scan.size()) result.of_bin = std::max(result.of_bin, m.error());
    return result;
}

/// The limits that the errors should keep.
struct limits {
    double overall, of_bin;
};

/// The row of scans of one kind.
json row_of(json row, const std::vector<std::optional<curve_error>>& scans, const limits& most) {
    curve_error worst;
    std::size_t without = 0, beyond = 0;
    for (const auto& e : scans) {
        if (!e) {
            ++without;
            continue;
        }
        worst.overall = std::max(worst.overall, e->overall);
        worst.of_bin = std::max(worst.of_bin, e->of_bin);
        beyond += e->overall > most.overall || e->of_bin > most.of_bin ? 1 : 0;
    }
    row.update({{"scans", scans.size()},
                {"without a curve", without},
                {"worst error [%]", rounded(100.0 * worst.overall, 2)},
                {"limit [%]", rounded(100.0 * most.overall, 0)},
                {"worst error of a bin [%]", rounded(100.0 * worst.of_bin, 2)},
                {"limit of a bin [%]", rounded(100.0 * most.of_bin, 0)},
                {"scans beyond a limit", beyond}});
    std::printf("%s\n", row.dump().c_str());
    std::fflush(stdout);
    return row;
}

/// Calls error_in(s) for all scans s of a row, on all cores.
std::vector<std::optional<curve_error>> errors_of(std::size_t scans, auto&& error_in) {
    std::vector<std::optional<curve_error>> errors(scans);
    gnomon::threads{}(scans, [&](std::size_t s) { errors[s] = error_in(s); });
    return errors;
}

std::optional<curve_error> error_of_room(const setting& how, std::uint64_t seed) {
    const sim::scene world = furnished(seed);
    const sim::true_scan truth = scan_of(world, sim::bvh_caster(world), how, 1000 * seed + 1);
    const auto found = gnomon::measure_noise(truth.scan);
    if (!found.curve) return std::nullopt;
    return error_of(
        *found.curve, truth, [&](std::size_t i) { return truth.ranges[i]; },
        [&](std::size_t) { return how.sigma() * how.sigma(); });
}

/// Of range finders. Ten rooms for each density and trajectory, at each noise.
json range_finders(bool quick) {
    constexpr limits most{0.03, 0.10};
    const std::size_t rooms = quick ? 1 : 10;
    json rows = json::array();
    for (const double noise : noises) {
        std::vector<std::optional<curve_error>> of_noise;
        std::uint64_t first = 10'001;
        for (const std::string density : densities) {
            for (const std::string trajectory : {"rotational", "vertical", "horizontal"}) {
                const setting how{noise, density, trajectory};
                const auto errors =
                    errors_of(rooms, [&](std::size_t r) { return error_of_room(how, first + r); });
                rows.push_back(row_of(
                    {{"noise [mm]", noise}, {"density", density}, {"trajectory", trajectory}},
                    errors, most));
                of_noise.insert(of_noise.end(), errors.begin(), errors.end());
                first += rooms;
            }
        }
        rows.push_back(row_of({{"noise [mm]", noise}, {"density", "all"}, {"trajectory", "all"}},
                              of_noise, most));
    }
    return rows;
}

/// @param quadratic  the standard deviation is this times the square of the depth [1/m]
std::optional<curve_error> error_of_image(double quadratic, std::uint64_t seed) {
    const sim::scene world = furnished(seed);
    sim::depth_camera camera = sim::scanners::structured_light();
    camera.noise = gnomon::quadratic_noise{.c = quadratic};
    const sim::true_scan truth =
        sim::simulate(world, world.sensor, camera, {.seed = 1000 * seed + 1});
    const auto found = gnomon::measure_noise(truth.scan);
    if (!found.curve) return std::nullopt;
    const Eigen::Vector3d axis = world.sensor.direction_out({1.0, 0.0, 0.0});
    const auto cosine_of = [&](std::size_t i) { return truth.directions[i].dot(axis); };
    const auto depth_of = [&](std::size_t i) { return truth.ranges[i] * cosine_of(i); };
    const double step_at_1 = camera.disparity_step / (camera.focal_length * camera.baseline);
    return error_of(*found.curve, truth, depth_of, [&](std::size_t i) {
        const double z = depth_of(i), sigma = quadratic * z * z, step = step_at_1 * z * z;
        return (sigma * sigma + step * step / 12.0) / (cosine_of(i) * cosine_of(i));
    });
}

/// Of depth cameras whose disparities come in eighths of a pixel.
json depth_cameras(bool quick) {
    constexpr limits most{0.07, 0.15};
    const std::size_t rooms = quick ? 2 : 10;
    json rows = json::array();
    for (const double quadratic : {0.0, 0.5e-3, 1.5e-3}) {
        const auto errors =
            errors_of(rooms, [&](std::size_t r) { return error_of_image(quadratic, 10'001 + r); });
        rows.push_back(row_of({{"noise at 1 m [mm]", 1e3 * quadratic}}, errors, most));
    }
    return rows;
}

/// Points all over a ball, seen from outside.
gnomon::scan ball() {
    gnomon::scan result;
    gnomon::random_stream random(1);
    while (result.size() < 50'000) {
        const Eigen::Vector3d p(random.uniform(-1, 1), random.uniform(-1, 1),
                                random.uniform(-1, 1));
        if (p.squaredNorm() <= 1.0) result.points.push_back(p + Eigen::Vector3d(3.0, 0.0, 0.0));
    }
    result.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
    return result;
}

/// Leaves: small spheres at random positions, seen with 5 mm of noise.
gnomon::scan leaves() {
    sim::scene world;
    const std::int32_t part = world.add_part(world.add_object("tree"), "leaves");
    gnomon::random_stream random(2);
    for (int leaf = 0; leaf < 4000; ++leaf)
        world.add(part, sim::sphere{0.03},
                  sim::at(random.uniform(2, 4), random.uniform(-1, 1), random.uniform(-1, 1)));
    return sim::simulate(world, sim::rotational{}, {}, {.sigma = 0.005}).scan;
}

/// Readings at random ranges.
gnomon::scan clutter() {
    const sim::scene world = furnished(10'001);
    return sim::simulate(world, sim::rotational{.mount = world.sensor}, {}, {.clutter = 1.0}).scan;
}

json without_planes() {
    json rows = json::array();
    const auto add = [&](const char* name, const gnomon::scan& scan) {
        const auto found = gnomon::measure_noise(scan);
        rows.push_back({{"scan", name},
                        {"points", scan.size()},
                        {"has a curve", found.curve.has_value()},
                        {"noise at 3 m [mm]", json("")},
                        {"reason", std::string(found.reason)}});
        if (found.curve) rows.back()["noise at 3 m [mm]"] = rounded(1e3 * (*found.curve)(3.0), 1);
        std::printf("%s\n", rows.back().dump().c_str());
    };
    add("a ball full of points", ball());
    add("a cloud of leaves", leaves());
    add("readings at random ranges", clutter());
    return rows;
}

json measure(const effort& much) {
    return {{"range finders", range_finders(much.quick)},
            {"depth cameras", depth_cameras(much.quick)},
            {"scans with little that is flat", without_planes()}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
