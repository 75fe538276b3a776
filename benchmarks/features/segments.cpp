// SPDX-License-Identifier: BSL-1.0
// Features of segments: how repeatable they are for the true parts of furnished rooms, and their
// times.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "two_scans.hpp"
#include <gnomon/features/convex_hull.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/minimum_volume_box.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/features/zernike_descriptor.hpp>

namespace {

// In the order in which the thesis presents them, Sec. 3.5.1 to Sec. 3.5.4.
const std::vector<std::string> features{"centroid",
                                        "mean normal",
                                        "mean surface variation",
                                        "deviations along the axes",
                                        "surface variation",
                                        "aspect ratio",
                                        "normal",
                                        "principal box",
                                        "minimum-area rectangle",
                                        "minimum-volume box",
                                        "area of the polygon",
                                        "corners of the polygon",
                                        "area of the hull",
                                        "volume of the hull",
                                        "vertices of the hull",
                                        "Zernike descriptor"};

/// A part with the surface elements of its points.
struct seen_part {
    std::vector<Eigen::Vector3d> points;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;

    [[nodiscard]] gnomon::segment_shape shape() const {
        std::vector<gnomon::point_index> all(points.size());
        std::iota(all.begin(), all.end(), gnomon::point_index{0});
        return gnomon::segment_shape::of(points, surface, all);
    }
};

/// The parts of a scan by their numbers.
std::map<std::int32_t, seen_part> parts_of(const sim::true_scan& truth) {
    auto surface = gnomon::estimate_normals(truth.scan, gnomon::knn{.k = 50}, gnomon::plane_pca{});
    gnomon::orient_normals(truth.scan, surface);
    std::map<std::int32_t, seen_part> parts;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        if (truth.parts[i] == sim::nothing || !gnomon::usable(surface[i].trust)) continue;
        seen_part& p = parts[truth.parts[i]];
        p.points.push_back(truth.scan.points[i]);
        p.surface.push_back(surface[i]);
    }
    return parts;
}

gnomon::convex_polygon polygon_of(const seen_part& p) {
    const auto frame = gnomon::principal_frame::of(p.points);
    return gnomon::convex_polygon::of(p.points,
                                      {frame.normal(), frame.normal().dot(frame.centroid)});
}

/// Calls visit(name, compute, distance) for each feature.
void for_each_feature(auto&& visit) {
    const auto difference = [](double a, double b) { return std::abs(a - b); };
    const auto euclidean = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return (a - b).norm();
    };
    const auto of_axes = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return a.cross(b).norm();
    };
    const auto hull = [](const seen_part& p) { return gnomon::convex_hull::of(p.points); };
    visit(
        "centroid", [](const auto& p) { return p.shape().frame.centroid; }, euclidean);
    visit(
        "mean normal", [](const auto& p) { return p.shape().mean_normal; }, euclidean);
    visit(
        "mean surface variation", [](const auto& p) { return p.shape().mean_surface_variation; },
        difference);
    visit(
        "deviations along the axes",
        [](const auto& p) { return p.shape().frame.spectrum.deviations(); }, euclidean);
    visit(
        "surface variation", [](const auto& p) { return p.shape().surface_variation(); },
        difference);
    visit(
        "aspect ratio", [](const auto& p) { return p.shape().aspect_ratio(); }, difference);
    visit(
        "normal", [](const auto& p) { return p.shape().normal; }, of_axes);
    visit(
        "principal box", [](const auto& p) { return p.shape().frame.box_size; }, euclidean);
    visit(
        "minimum-area rectangle",
        [](const auto& p) { return gnomon::minimum_area_rectangle(polygon_of(p)).lengths; },
        euclidean);
    visit(
        "minimum-volume box",
        [](const auto& p) { return gnomon::minimum_volume_box(p.points).lengths; }, euclidean);
    visit(
        "area of the polygon", [](const auto& p) { return polygon_of(p).area; }, difference);
    visit(
        "corners of the polygon",
        [](const auto& p) { return static_cast<double>(polygon_of(p).outline.size()); },
        difference);
    visit(
        "area of the hull", [=](const auto& p) { return hull(p).area; }, difference);
    visit(
        "volume of the hull", [=](const auto& p) { return hull(p).volume; }, difference);
    visit(
        "vertices of the hull",
        [=](const auto& p) { return static_cast<double>(hull(p).vertices.size()); }, difference);
    visit(
        "Zernike descriptor",
        [](const auto& p) { return gnomon::zernike_descriptor::of(p.points); },
        [](const auto& a, const auto& b) { return a.distance(b); });
}

/// "chair 3/leg 2" is a "chair/leg".
std::string kind_of(const sim::scene& world, std::int32_t part) {
    const sim::scene_part& p = world.parts()[static_cast<std::size_t>(part)];
    std::string name = world.objects()[static_cast<std::size_t>(p.object)] + "/" + p.name;
    std::erase_if(name, [](char c) { return (c >= '0' && c <= '9') || c == ' '; });
    return name;
}

all_distances distances_of(const two_scans& room) {
    constexpr std::size_t fewest = 100;
    auto first = parts_of(room.scans[0]), second = parts_of(room.scans[1]);
    std::vector<std::string> kinds;
    std::vector<seen_part> a, b;
    for (auto& [number, part] : first) {
        const auto again = second.find(number);
        if (again == second.end() || part.points.size() < fewest ||
            again->second.points.size() < fewest)
            continue;
        kinds.push_back(kind_of(room.world, number));
        a.push_back(std::move(part));
        b.push_back(std::move(again->second));
    }
    compared_pairs pairs;
    for (std::size_t i = 0; i < a.size(); ++i)
        for (std::size_t j = 0; j < b.size(); ++j) {
            if (i == j)
                pairs.same.emplace_back(i, j);
            else if (kinds[i] != kinds[j])
                pairs.different.emplace_back(i, j);
        }
    all_distances all;
    for_each_feature([&](const char* name, auto&& compute, auto&& distance) {
        using value = std::decay_t<decltype(compute(a[0]))>;
        values_of<value> of_a, of_b;
        for (std::size_t i = 0; i < a.size(); ++i) {
            of_a.push_back(compute(a[i]));
            of_b.push_back(compute(b[i]));
        }
        all[name].add(pairs, of_a, of_b, distance);
    });
    return all;
}

/// Of the parts of one room.
json times(const effort& much) {
    const two_scans room({15.0, "whole", "rotational"}, first_seed);
    std::vector<seen_part> parts;
    std::size_t points = 0;
    for (auto& [number, part] : parts_of(room.scans[0])) {
        if (part.points.size() < 100) continue;
        points += part.points.size();
        parts.push_back(part);
    }
    json rows = json::array();
    for_each_feature([&](const std::string& feature, auto&& compute, auto&&) {
        constexpr std::ptrdiff_t of_shape = 8;  // features of one call
        const auto number = std::ranges::find(features, feature) - features.begin();
        if (number > 0 && number < of_shape) return;
        const std::string name = number == 0 ? "the first eight, by `segment_shape`" : feature;
        const double t = seconds_of(much, [&] {
            for (const seen_part& p : parts) (void)compute(p);
        });
        rows.push_back(
            {{"feature", name},
             {"segments", parts.size()},
             {"points", points},
             {"time of a segment [us]", rounded(1e6 * t / static_cast<double>(parts.size()), 1)},
             {"of a point [ns]", rounded(1e9 * t / static_cast<double>(points), 1)}});
    });
    return rows;
}

json measure(const effort& much) {
    const auto measured = [&](std::span<const char* const> of_lines, double apart) {
        return measured_features(features, much, of_lines,
                                 [=](const setting& how, std::uint64_t seed) {
                                     return distances_of(two_scans(how, seed, apart));
                                 });
    };
    constexpr std::array only{"whole"};
    const auto here = measured(densities, 0.0), there = measured(only, 0.6);
    return {{"by noise", here.by_noise()},
            {"by density", here.by_density()},
            {"ratios of distances", here.ratios()},
            {"by noise, from two positions", there.by_noise()},
            {"ratios of distances, from two positions", there.ratios()},
            {"times", times(much)}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
