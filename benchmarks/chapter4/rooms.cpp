// SPDX-License-Identifier: BSL-1.0
#include "rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <stdexcept>

#include "picture/of_perception.hpp"

namespace sim = gnomon::simulation;

namespace {

constexpr double forearm = 0.25;  // from the elbow to the sensor [m]

sim::true_scan simulated(const dataset& d, const auto& trajectory, std::uint64_t seed) {
    return sim::simulate(d.world, trajectory, sim::scanner{},
                         {.sigma = noise_of_rooms, .seed = seed}, gnomon::threads{});
}

template <class Merge>
perceived perceived_as_thesis(const sim::true_scan& truth) {
    const gnomon::perception<gnomon::knn, gnomon::plane_pca, Merge, gnomon::smooth_surfaces> chain{
        .noise = gnomon::constant_noise{noise_of_rooms}, .leave_out = gnomon::floor_and_ceiling{}};
    return chain(truth.scan);
}

}  // namespace

sim::true_scan dataset::scan(std::uint64_t seed) const {
    if (trajectory == 'V')
        return simulated(*this, sim::vertical{.mount = world.sensor, .duration = seconds()}, seed);
    if (trajectory == 'R')
        return simulated(*this, sim::rotational{.mount = world.sensor, .duration = seconds()},
                         seed);
    const sim::horizontal elbow{.mount = world.sensor * sim::at(-forearm, 0, 0),
                                .duration = seconds()};
    return simulated(*this,
                     sim::along(seconds(),
                                [elbow](double time) {
                                    // The scan lines stand upright: a roll that the forearm does
                                    // not have.
                                    return elbow(time) * sim::roll(gnomon::degrees(-90)) *
                                           sim::at(forearm, 0, 0) * sim::roll(gnomon::degrees(90));
                                }),
                     seed);
}

std::vector<dataset> datasets() {
    using namespace sim::scenes;
    return {{"Kitchen R", kitchen(), 'R', 160},         {"Living Room R", living_room(), 'R', 160},
            {"Two Chairs H", two_chairs(), 'H', 276},   {"Two Chairs V", two_chairs(), 'V', 332},
            {"Two Chairs R", two_chairs(), 'R', 158},   {"SAT H", seat_armchair_table(), 'H', 412},
            {"SAT V", seat_armchair_table(), 'V', 413}, {"SAT R", seat_armchair_table(), 'R', 220}};
}

dataset dataset_of(const std::string& name) {
    for (dataset& d : datasets())
        if (d.name == name) return d;
    throw std::out_of_range("no data set " + name);
}

perceived perceive(const sim::true_scan& truth) {
    const gnomon::perception<> chain{.leave_out = gnomon::floor_and_ceiling{}};
    return chain(truth.scan);
}

perceived perceive_liberally(const sim::true_scan& truth) {
    const gnomon::perception<gnomon::noise_knn, gnomon::plane_pca, gnomon::liberal> chain{
        .leave_out = gnomon::floor_and_ceiling{}};
    return chain(truth.scan);
}

perceived perceive_as_thesis(const sim::true_scan& truth) {
    return perceived_as_thesis<gnomon::conservative>(truth);
}

perceived segment_as_thesis(const sim::true_scan& truth) {
    return perceived_as_thesis<gnomon::no_merging>(truth);
}

double seconds_of(const perceived& seen, std::string_view step) {
    for (const auto& s : seen.steps)
        if (s.name == step) return s.seconds;
    return 0.0;
}

namespace {

/// For each kept point, one over the number of kept points that were seen in the same pixel.
std::vector<double> shares_of_pixels(const sim::true_scan& truth, const perceived& seen) {
    const auto pixel_of = [&](gnomon::point_index i) {
        const Eigen::Vector3d& d = truth.directions[i];
        const auto whole_degrees = [](double radians) {
            return static_cast<int>(std::floor(radians / gnomon::degrees(1).radians()));
        };
        return std::array{whole_degrees(std::asin(std::clamp(d.z(), -1.0, 1.0))),
                          whole_degrees(std::atan2(d.y(), d.x()))};
    };
    std::map<std::array<int, 2>, double> points;
    for (const auto i : seen.kept) points[pixel_of(i)] += 1.0;
    std::vector<double> shares(truth.scan.size(), 0.0);
    for (const auto i : seen.kept) shares[i] = 1.0 / points[pixel_of(i)];
    return shares;
}

struct overlap {
    double iou = 0.0;
    std::int32_t segment = gnomon::unlabeled;
};

/// Of a surface with the segment that it has most in common with, points counting by weight.
overlap best_overlap(const sim::true_scan& truth, const perceived& seen,
                     const gnomon::segments& parts, std::int32_t surface,
                     const std::vector<double>& weight) {
    double whole = 0.0;
    std::map<std::int32_t, double> common, size;
    for (const auto i : seen.kept) {
        const std::int32_t label = parts.labels()[i];
        size[label] += weight[i];
        if (truth.surfaces[i] != surface) continue;
        whole += weight[i];
        common[label] += weight[i];
    }
    overlap best;
    for (const auto& [label, both] : common) {
        const double iou = both / (whole + size[label] - both);
        if (label != gnomon::unlabeled && iou > best.iou) best = {iou, label};
    }
    return best;
}

}  // namespace

recovery recovery_of(const sim::true_scan& truth, const perceived& seen, std::int32_t surface) {
    recovery r;
    for (const auto i : seen.kept) r.points += truth.surfaces[i] == surface ? 1 : 0;
    for (std::size_t f = 0; f < seen.initial_segments.size(); ++f) {
        const auto members = seen.initial_segments[f];
        const auto of_it = std::count_if(members.begin(), members.end(),
                                         [&](auto i) { return truth.surfaces[i] == surface; });
        r.initial_segments += 2 * static_cast<std::size_t>(of_it) > members.size() ? 1 : 0;
    }
    const std::vector<double> alike(truth.scan.size(), 1.0);
    r.iou_before = best_overlap(truth, seen, seen.initial_segments, surface, alike).iou;
    const overlap after = best_overlap(truth, seen, seen.surfaces, surface, alike);
    r.iou = after.iou;
    r.segment = after.segment;
    r.iou_of_area =
        best_overlap(truth, seen, seen.surfaces, surface, shares_of_pixels(truth, seen)).iou;
    return r;
}

json recovery_table(const std::vector<dataset>& scans, const std::vector<std::string>& surfaces,
                    const effort& much) {
    json rows = json::array();
    for (const dataset& d : scans) {
        std::vector<std::vector<recovery>> of_surface(surfaces.size());
        for (unsigned seed = 1; seed <= much.seeds(); ++seed) {
            const sim::true_scan truth = d.scan(seed);
            const perceived seen = perceive(truth);
            for (std::size_t s = 0; s < surfaces.size(); ++s)
                of_surface[s].push_back(
                    recovery_of(truth, seen, d.world.find_surface(surfaces[s])));
        }
        for (std::size_t s = 0; s < surfaces.size(); ++s) {
            const auto& seeds = of_surface[s];
            const auto least = [&](auto member) {
                return std::ranges::min(seeds, {}, member).*member;
            };
            const auto mean = [&](auto member) {
                double sum = 0.0;
                for (const recovery& r : seeds) sum += static_cast<double>(r.*member);
                return sum / static_cast<double>(seeds.size());
            };
            rows.push_back({{"scan", d.name},
                            {"surface", surfaces[s]},
                            {"points", seeds.front().points},
                            {"initial segments", rounded(mean(&recovery::initial_segments), 1)},
                            {"IoU before merging", rounded(mean(&recovery::iou_before), 3)},
                            {"IoU", rounded(mean(&recovery::iou), 3)},
                            {"least IoU", rounded(least(&recovery::iou), 3)},
                            {"least IoU of area", rounded(least(&recovery::iou_of_area), 3)}});
        }
    }
    return rows;
}

void draw(const sim::true_scan& truth, const perceived& seen, const std::filesystem::path& file) {
    const std::vector<std::string> sizes = picture::sizes_of(seen.surfaces);
    const auto sheet = picture::picture_of(picture::splats_of(truth.scan, seen), sizes, "segment",
                                           truth.scan.viewpoints[0], Eigen::Vector3d::UnitZ(),
                                           picture::color_of, picture::gaps_of(truth.scan, seen));
    gnomon::io::replace_file(file, sheet.png());
}

void draw(const std::vector<Eigen::Vector3d>& points, const std::vector<Eigen::Vector3d>& normals,
          const gnomon::segments& groups, const Eigen::Vector3d& viewpoint,
          const std::filesystem::path& file) {
    constexpr double radius = 0.01;
    std::vector<picture::splat> splats;
    for (std::size_t i = 0; i < points.size(); ++i)
        splats.push_back({points[i], normals.empty() ? Eigen::Vector3d::Zero() : normals[i], radius,
                          groups.labels()[i]});
    const auto sheet = picture::picture_of(splats, picture::sizes_of(groups), "group", viewpoint,
                                           Eigen::Vector3d::UnitZ());
    gnomon::io::replace_file(file, sheet.png());
}
