// SPDX-License-Identifier: BSL-1.0
// Features and descriptors of points: how repeatable they are in furnished rooms, and their times.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "two_scans.hpp"
#include <gnomon/features/describe_points.hpp>
#include <gnomon/features/harmonic_shape_context.hpp>
#include <gnomon/features/shape_context.hpp>
#include <gnomon/features/spin_image.hpp>
#include <gnomon/features/surface_type.hpp>

namespace {

using keypoints = std::vector<gnomon::point_index>;

// The neighbors of all features are those within 20 cm, chosen before any measurement [m].
constexpr double reach = 0.2;

// In the order in which the thesis presents them, from Sec. 3.2 to Sec. 3.4.2.
const std::vector<std::string> features{
    "normal",        "aspect ratio",          "surface variation", "curvature, as printed",
    "curvature",     "Besl-Jain type",        "spin image",        "spin image of normals",
    "shape context", "harmonic shape context"};

// The ball of 20 cm contains the cylinder.
const gnomon::spin_image spin{.radius = reach / std::numbers::sqrt2,
                              .height = std::numbers::sqrt2 * reach,
                              .normalize = true};
const gnomon::angular_spin_image angular_spin{.bins = spin};
const gnomon::shape_context context{.radius = reach, .normalize = true};
const gnomon::harmonic_shape_context harmonic{.radius = reach, .normalize = true};

/// A scan with its index and normals.
struct prepared_scan {
    const sim::true_scan& truth;
    gnomon::spatial_index index;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;

    explicit prepared_scan(const sim::true_scan& scan)
        : truth(scan),
          index(scan.scan),
          surface(gnomon::estimate_normals(index, gnomon::knn{.k = 50}, gnomon::plane_pca{})) {
        gnomon::orient_normals(scan.scan, surface);
    }

    void neighbors_of(std::size_t i, std::vector<Eigen::Vector3d>& positions) const {
        positions.clear();
        for (const gnomon::neighbor& q : index.within(index[i], reach))
            if (q.index != i) positions.push_back(index[q.index]);
    }

    /// value_of(i, neighbors) for each keypoint, where its normal is usable.
    [[nodiscard]] auto each(const keypoints& keys, auto&& value_of) const {
        using value = std::invoke_result_t<decltype(value_of), std::size_t,
                                           const std::vector<Eigen::Vector3d>&>;
        std::vector<value> result;
        std::vector<Eigen::Vector3d> positions;
        for (const auto i : keys) {
            if (!gnomon::usable(surface[i].trust)) {
                result.emplace_back();
                continue;
            }
            neighbors_of(i, positions);
            result.push_back(value_of(i, positions));
        }
        return result;
    }
};

std::optional<gnomon::spectrum> spectrum_of(const prepared_scan& s, std::size_t i,
                                            std::vector<Eigen::Vector3d> positions) {
    positions.push_back(s.index[i]);
    return gnomon::principal_frame::of(positions).spectrum;
}

std::optional<gnomon::curvature> curvature_by(const auto& estimate, const prepared_scan& s,
                                              std::size_t i,
                                              const std::vector<Eigen::Vector3d>& positions) {
    const gnomon::curvature c = estimate(s.index[i], s.surface[i].normal, positions);
    return gnomon::usable(c.trust) ? std::optional(c) : std::nullopt;
}

values_of<std::vector<float>> rows_of(const gnomon::point_descriptors& all) {
    values_of<std::vector<float>> rows;
    for (std::size_t r = 0; r < all.size(); ++r) {
        if (gnomon::usable(all.trust[r]))
            rows.emplace_back(std::vector<float>(all[r].begin(), all[r].end()));
        else
            rows.emplace_back();
    }
    return rows;
}

/// Calls visit(name, compute, distance) for each feature, where compute(scan, keypoints) gives
/// values_of something.
void for_each_feature(auto&& visit) {
    const auto difference = [](double a, double b) { return std::abs(a - b); };
    const auto of_spectrum = [](auto&& number) {
        return [number](const prepared_scan& s, const keypoints& keys) {
            return s.each(keys, [&](std::size_t i, const auto& positions) {
                return std::optional<double>(number(*spectrum_of(s, i, positions)));
            });
        };
    };
    const auto curvatures = [](const auto& estimate) {
        return [&estimate](const prepared_scan& s, const keypoints& keys) {
            return s.each(keys, [&](std::size_t i, const auto& positions) {
                return curvature_by(estimate, s, i, positions);
            });
        };
    };
    const auto of_curvatures = [](const gnomon::curvature& a, const gnomon::curvature& b) {
        return std::hypot(a.kappa1 - b.kappa1, a.kappa2 - b.kappa2);
    };
    static const gnomon::shape_operator_curvature fit;
    static const gnomon::thesis_curvature as_printed;
    visit(
        "normal",
        [](const prepared_scan& s, const keypoints& keys) {
            values_of<Eigen::Vector3d> all;
            for (const auto i : keys)
                all.push_back(gnomon::usable(s.surface[i].trust)
                                  ? std::optional(s.surface[i].normal)
                                  : std::nullopt);
            return all;
        },
        [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return (a - b).norm(); });
    visit("aspect ratio", of_spectrum([](const auto& s) { return s.aspect_ratio(); }), difference);
    visit("surface variation", of_spectrum([](const auto& s) { return s.surface_variation(); }),
          difference);
    visit("curvature, as printed", curvatures(as_printed), of_curvatures);
    visit("curvature", curvatures(fit), of_curvatures);
    visit(
        "Besl-Jain type",
        [curvatures](const prepared_scan& s, const keypoints& keys) {
            values_of<gnomon::surface_type> types;
            for (const auto& c : curvatures(as_printed)(s, keys))
                types.push_back(c ? std::optional(gnomon::besl_jain{}(*c)) : std::nullopt);
            return types;
        },
        [](gnomon::surface_type a, gnomon::surface_type b) { return a == b ? 0.0 : 1.0; });
    const auto descriptors = [&](const char* name, const auto& d) {
        visit(
            name,
            [&d](const prepared_scan& s, const keypoints& keys) {
                return rows_of(gnomon::describe_points(s.index, s.surface, keys, d));
            },
            [&d](const std::vector<float>& a, const std::vector<float>& b) {
                return d.distance(a, b);
            });
    };
    descriptors("spin image", spin);
    descriptors("spin image of normals", angular_spin);
    descriptors("shape context", context);
    descriptors("harmonic shape context", harmonic);
}

std::vector<Eigen::Vector3d> true_places(const sim::true_scan& truth) {
    std::vector<Eigen::Vector3d> all;
    for (std::size_t i = 0; i < truth.scan.size(); ++i)
        all.push_back(truth.scan.viewpoints[i] + truth.ranges[i] * truth.directions[i]);
    return all;
}

/// Places of two scans, and the pairs of them.
struct places {
    std::array<keypoints, 2> keys;
    compared_pairs pairs;

    places(const two_scans& room, std::uint64_t seed) {
        const sim::true_scan &a = room.scans[0], &b = room.scans[1];
        const gnomon::spatial_index of_a(true_places(a)), of_b(true_places(b));
        gnomon::random_stream random(seed, 1);
        std::map<std::int32_t, std::size_t> of_surface;
        constexpr std::size_t trials = 20'000, most = 300, most_of_surface = 10;
        for (std::size_t t = 0; t < trials && keys[0].size() < most; ++t) {
            const auto i = static_cast<gnomon::point_index>(random.below(a.scan.size()));
            const std::int32_t surface = a.surfaces[i];
            if (surface == sim::nothing || of_surface[surface] == most_of_surface) continue;
            if (!is_distinctive(a, of_a, i)) continue;
            const auto j = nearest(b, of_b, of_a[i], surface);
            if (!j) continue;
            ++of_surface[surface];
            keys[0].push_back(i);
            keys[1].push_back(*j);
        }
        for (std::size_t k = 0; k < keys[0].size(); ++k) {
            pairs.same.emplace_back(k, k);
            for (int other = 0; other < 4; ++other) {
                const std::size_t l = random.below(keys[0].size());
                if (a.surfaces[keys[0][k]] != a.surfaces[keys[0][l]])
                    pairs.different.emplace_back(k, l);
            }
        }
    }

  private:
    /// Whether a fifth of the neighbors are truly off the tangent plane, by 2 cm.
    static bool is_distinctive(const sim::true_scan& truth, const gnomon::spatial_index& index,
                               std::size_t i) {
        std::size_t all = 0, off = 0;
        for (const gnomon::neighbor& q : index.within(index[i], reach)) {
            ++all;
            off += std::abs(truth.normals[i].dot(index[q.index] - index[i])) > 0.02 ? 1 : 0;
        }
        return 5 * off >= all;
    }

    /// The nearest point of a surface, at most 5 cm away.
    static std::optional<gnomon::point_index> nearest(const sim::true_scan& truth,
                                                      const gnomon::spatial_index& index,
                                                      const Eigen::Vector3d& at,
                                                      std::int32_t surface) {
        std::optional<gnomon::point_index> best;
        double least = std::numeric_limits<double>::infinity();
        for (const gnomon::neighbor& q : index.within(at, 0.05)) {
            const double d = (index[q.index] - at).squaredNorm();
            if (truth.surfaces[q.index] != surface || d >= least) continue;
            least = d;
            best = q.index;
        }
        return best;
    }
};

all_distances distances_of(const setting& how, std::uint64_t seed) {
    const two_scans room(how, seed);
    const places at(room, seed);
    const prepared_scan a(room.scans[0]), b(room.scans[1]);
    all_distances all;
    for_each_feature([&](const char* name, auto&& compute, auto&& distance) {
        all[name].add(at.pairs, compute(a, at.keys[0]), compute(b, at.keys[1]), distance);
    });
    return all;
}

/// Of points all over one room, with the search for their neighbors.
json times(const effort& much) {
    const two_scans room({15.0, "whole", "rotational"}, first_seed);
    const prepared_scan s(room.scans[0]);
    const std::size_t number = much.quick ? 300 : 5000;
    keypoints keys;
    std::size_t neighbors = 0;
    std::vector<Eigen::Vector3d> positions;
    for (std::size_t k = 0; k < number; ++k) {
        const std::size_t i = k * s.index.size() / number;
        if (!gnomon::usable(s.surface[i].trust)) continue;
        keys.push_back(static_cast<gnomon::point_index>(i));
        s.neighbors_of(i, positions);
        neighbors += positions.size();
    }
    const auto n = static_cast<double>(keys.size());
    json rows = json::array();
    for_each_feature([&](const char* name, auto&& compute, auto&&) {
        if (std::string(name) == "normal") return;
        const double t = seconds_of(much, [&] { (void)compute(s, keys); });
        rows.push_back({{"feature", name},
                        {"points", keys.size()},
                        {"neighbors", rounded(static_cast<double>(neighbors) / n, 0)},
                        {"time of a point [us]", rounded(1e6 * t / n, 2)}});
    });
    return rows;
}

json measure(const effort& much) {
    const measured_features measured(features, much, densities, distances_of);
    return {{"by noise", measured.by_noise()},
            {"by density", measured.by_density()},
            {"times", times(much)}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
