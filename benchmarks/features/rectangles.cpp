// SPDX-License-Identifier: BSL-1.0
// Edges of flat surfaces: the rectangle of smallest area around the points of each true surface,
// compared with that around the same points without noise; with view points and without.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "../surfaces/joined_surfaces.hpp"
#include "two_scans.hpp"
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/segmentation/plane_estimate.hpp>

namespace {

using positions = std::vector<Eigen::Vector3d>;

constexpr double noise = 15.0;  // [mm]

/// The outline of points in their plane, and its rectangle.
struct outlined {
    double area = 0.0;  ///< of the outline [m^2]
    gnomon::oriented_box rectangle;

    /// @param points  with view points or without
    explicit outlined(const auto& points) {
        const gnomon::segments whole(std::vector<std::int32_t>(points.size(), 0));
        const gnomon::noise_curve of_ranges = gnomon::constant_noise{1e-3 * noise};
        const auto plane = gnomon::estimate_planes(points, whole, of_ranges).at(0).plane;
        const auto polygon = gnomon::convex_polygon::of(points, plane);
        area = polygon.area;
        rectangle = gnomon::minimum_area_rectangle(polygon);
    }
};

/// The median distance of a point to its nearest neighbor [m].
double spacing_of(const positions& points) {
    const gnomon::spatial_index index(points);
    std::vector<double> distances;
    const auto nearest = gnomon::knn{.k = 1}(index);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (const auto q : nearest[i]) distances.push_back((points[q] - points[i]).norm());
    return median_of(std::move(distances));
}

/// The errors of a rectangle.
struct rectangle_error {
    double length = 0.0;   ///< the larger error of an edge, in magnitude [m]
    double excess = 0.0;   ///< the mean error of both edges [m]
    double angle = 0.0;    ///< of the axes, modulo 90 degrees [degrees]
    double spacing = 0.0;  ///< of points [m]
    bool is_rectangular = false;
    bool is_disk = false;     ///< which has no axes
    bool is_oblique = false;  ///< to the ray at its center, by more than 45 degrees

    rectangle_error(const outlined& found, const positions& true_ones,
                    const Eigen::Vector3d& viewpoint)
        : spacing(spacing_of(true_ones)) {
        const outlined truth(gnomon::with_viewpoint(true_ones, viewpoint));
        const Eigen::Vector3d difference = found.rectangle.lengths - truth.rectangle.lengths;
        length = std::max(std::abs(difference[0]), std::abs(difference[1]));
        excess = 0.5 * (difference[0] + difference[1]);
        const Eigen::Vector3d u = found.rectangle.axes.col(0), v = truth.rectangle.axes.col(0);
        constexpr double degrees_of_radian = 57.29577951308232;
        const double turned = degrees_of_radian * std::atan2(u.cross(v).norm(), std::abs(u.dot(v)));
        angle = std::min(turned, 90.0 - turned);
        const double filled =
            truth.area / (truth.rectangle.lengths[0] * truth.rectangle.lengths[1]);
        constexpr double of_disk = 0.785, close = 0.02;
        is_rectangular = filled >= 0.9;
        is_disk = std::abs(filled - of_disk) < close &&
                  truth.rectangle.lengths[1] > (1.0 - close) * truth.rectangle.lengths[0];
        const Eigen::Vector3d ray = truth.rectangle.center - viewpoint;
        constexpr double oblique = 0.7071067811865476;  // the cosine of 45 degrees
        is_oblique = std::abs(ray.dot(truth.rectangle.axes.col(2))) < oblique * ray.norm();
    }

    [[nodiscard]] bool has_lengths() const { return length <= 0.02 + spacing; }
    [[nodiscard]] bool has_axes() const { return angle <= 2.0; }
};

/// The errors of all surfaces.
struct all_errors {
    std::vector<rectangle_error> seen, unseen;  // with view points, and without
};

/// Adds the flat surfaces of a scan with 200 points and more.
void add_surfaces(all_errors& errors, const sim::true_scan& truth) {
    std::vector<gnomon::point_index> all;
    for (gnomon::point_index i = 0; i < truth.scan.size(); ++i)
        if (truth.surfaces[i] != sim::nothing) all.push_back(i);
    const joined_surfaces surfaces(truth, all);
    std::map<std::int32_t, std::pair<positions, positions>> points;
    for (const auto i : all) {
        auto& [noisy, true_ones] = points[surfaces.of(i)];
        noisy.push_back(truth.scan.points[i]);
        true_ones.push_back(true_place(truth, i));
    }
    constexpr std::size_t fewest = 200;
    const Eigen::Vector3d eye = truth.scan.viewpoints[0];
    for (const auto& [surface, both] : points) {
        if (both.first.size() < fewest || !surfaces.is_flat(surface)) continue;
        const auto& [noisy, true_ones] = both;
        errors.seen.emplace_back(outlined(gnomon::with_viewpoint(noisy, eye)), true_ones, eye);
        errors.unseen.emplace_back(outlined(noisy), true_ones, eye);
    }
}

void add_row(json& rows, const char* scans, const char* which,
             const std::vector<rectangle_error>& errors, auto&& is_counted) {
    std::size_t number = 0, with_lengths = 0, with_axes = 0, with_both = 0;
    std::vector<double> lengths, excesses, angles, spacings;
    for (const rectangle_error& e : errors) {
        if (!is_counted(e)) continue;
        ++number;
        with_lengths += e.has_lengths() ? 1 : 0;
        with_axes += e.has_axes() ? 1 : 0;
        with_both += e.has_lengths() && e.has_axes() ? 1 : 0;
        lengths.push_back(e.length);
        excesses.push_back(e.excess);
        angles.push_back(e.angle);
        spacings.push_back(e.spacing);
    }
    if (number == 0) return;
    const auto share = [&](std::size_t n) {
        return rounded(100.0 * static_cast<double>(n) / static_cast<double>(number), 1);
    };
    rows.push_back({{"scans", scans},
                    {"surfaces", which},
                    {"number", number},
                    {"right edges and axes [%]", share(with_both)},
                    {"right edges [%]", share(with_lengths)},
                    {"right axes [%]", share(with_axes)},
                    {"median error of an edge [mm]", rounded(1e3 * median_of(lengths), 1)},
                    {"median excess [mm]", rounded(1e3 * median_of(excesses), 1)},
                    {"median error of the axes [degrees]", rounded(median_of(angles), 2)},
                    {"median spacing [mm]", rounded(1e3 * median_of(spacings), 1)}});
    std::printf("%s\n", rows.back().dump().c_str());
    std::fflush(stdout);
}

void add_rows(json& rows, const char* scans, const std::vector<rectangle_error>& errors) {
    add_row(rows, scans, "all", errors, [](const auto&) { return true; });
    add_row(rows, scans, "oblique", errors, [](const auto& e) { return e.is_oblique; });
    add_row(rows, scans, "not oblique", errors, [](const auto& e) { return !e.is_oblique; });
    add_row(rows, scans, "rectangular", errors, [](const auto& e) { return e.is_rectangular; });
    add_row(rows, scans, "not rectangular", errors,
            [](const auto& e) { return !e.is_rectangular; });
    add_row(rows, scans, "disks", errors, [](const auto& e) { return e.is_disk; });
}

json measure(const effort& much) {
    const std::size_t rooms = much.quick ? 2 : 20;
    all_errors of_rooms;
    for (std::size_t r = 0; r < rooms; ++r) {
        const std::uint64_t seed = first_seed + 100 + r;
        const sim::scene world = furnished(seed);
        add_surfaces(of_rooms, scan_of(world, sim::bvh_caster(world),
                                       {noise, "whole", "rotational"}, 1000 * seed + 1));
    }
    const auto models = sim::furniture_models();
    all_errors of_furniture;
    for (std::size_t m = 0; m < (much.quick ? 2 : models.size()); ++m) {
        for (int direction = 0; direction < 8; ++direction) {
            constexpr double away = 2.0, height = 1.2;  // [m]
            sim::scene world;
            sim::add(world, models[m],
                     sim::at(away, 0.0, 0.0) *
                         sim::yaw(gnomon::degrees(45.0 * static_cast<double>(direction) + 10.0)));
            world.sensor = sim::at(0.0, 0.0, height) * sim::pitch(gnomon::degrees(10));
            add_surfaces(of_furniture,
                         scan_of(world, sim::bvh_caster(world), {noise, "whole", "rotational"},
                                 first_seed + 200 + 8 * m + static_cast<std::size_t>(direction)));
        }
    }
    json seen = json::array(), unseen = json::array();
    add_rows(seen, "rooms", of_rooms.seen);
    add_rows(seen, "furniture", of_furniture.seen);
    add_rows(unseen, "rooms", of_rooms.unseen);
    add_rows(unseen, "furniture", of_furniture.unseen);
    return {{"rectangles", seen}, {"rectangles, without view points", unseen}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
