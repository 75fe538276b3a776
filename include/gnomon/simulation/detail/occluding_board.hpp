// SPDX-License-Identifier: BSL-1.0
/// @file
/// A board in front of an object that hides a given share of its points.
///
/// The board is a rectangle of no thickness in an upright plane, so that it hides exactly the
/// points whose central projection from the sensor onto that plane lies in it: its edge is a
/// quantile of the projected points of a scan without the board.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// The side of an object that is hidden, as the sensor sees it.
enum class occluded_side : char { left, right, bottom };

/// The edge above which all but `below` of the sorted coordinates lie. Within coordinates that are
/// equal up to rounding, as those of a scan line may be, there is no edge: it is moved to the
/// nearer end of them. Precondition: below < the number of coordinates.
[[nodiscard]] inline double edge_above(const std::vector<double>& sorted, std::size_t below) {
    constexpr double rounding = 1e-7;  // [m]
    const auto value = sorted.begin() + static_cast<std::ptrdiff_t>(below);
    const auto first = std::lower_bound(sorted.begin(), value, *value - rounding);
    const auto last = std::upper_bound(value, sorted.end(), *value + rounding);
    const auto edge = value - first <= last - value ? first : last;
    if (edge == sorted.begin()) return sorted.front() - rounding;
    if (edge == sorted.end()) return sorted.back() + rounding;
    return 0.5 * (*(edge - 1) + *edge);
}

/// The central projection of points from the sensor onto an upright plane.
struct projected_points {
    pose frame;               ///< at the sensor, x level towards the middle of the points
    double distance = 0.0;    ///< of the plane: half that of the nearest point, along x [m]
    std::vector<double> y{};  ///< of the points before the sensor, in the plane [m]
    std::vector<double> z{};

    projected_points(const Eigen::Vector3d& sensor, const std::vector<Eigen::Vector3d>& points) {
        bounds all;
        for (const Eigen::Vector3d& p : points) all.extend(p - sensor);
        const Eigen::Vector3d middle = all.middle();
        frame.position = sensor;
        frame = frame * yaw(radians(std::atan2(middle.y(), middle.x())));
        double nearest = std::numeric_limits<double>::infinity();
        for (const Eigen::Vector3d& p : points) {
            const double x = frame.point_in(p).x();
            if (x > 0.0) nearest = std::min(nearest, x);
        }
        distance = 0.5 * nearest;
        for (const Eigen::Vector3d& p : points) {
            const Eigen::Vector3d q = frame.point_in(p);
            if (!(q.x() > 0.0)) continue;
            y.push_back(q.y() * distance / q.x());
            z.push_back(q.z() * distance / q.x());
        }
    }
};

/// Adds an object "board" that hides about this share of the points of a scan of the scene on one
/// side; nothing if that is less than half a point. Points behind the sensor, those of an object
/// around it, are neither hidden nor counted.
inline void add_board(scene& world, const Eigen::Vector3d& sensor,
                      const std::vector<Eigen::Vector3d>& points, occluded_side side,
                      double share) {
    if (points.empty()) return;
    const projected_points projected(sensor, points);
    const std::size_t n = projected.y.size();
    const auto hidden = static_cast<std::size_t>(std::round(share * static_cast<double>(n)));
    if (hidden == 0) return;

    // Wider than the beams that meet the hidden points [m].
    constexpr double margin = 0.1;
    const auto [right, left] = std::minmax_element(projected.y.begin(), projected.y.end());
    const auto [bottom, top] = std::minmax_element(projected.z.begin(), projected.z.end());
    std::array<double, 2> across{*right - margin, *left + margin};
    std::array<double, 2> upright{*bottom - margin, *top + margin};
    std::vector<double> along = side == occluded_side::bottom ? projected.z : projected.y;
    if (side != occluded_side::left)
        for (double& c : along) c = -c;
    std::sort(along.begin(), along.end());
    const double edge = edge_above(along, n - hidden);
    switch (side) {
        case occluded_side::left:
            across[0] = edge;
            break;
        case occluded_side::right:
            across[1] = -edge;
            break;
        case occluded_side::bottom:
            upright[1] = -edge;
            break;
    }
    const pose place = projected.frame *
                       at(projected.distance, 0.5 * (across[0] + across[1]),
                          0.5 * (upright[0] + upright[1])) *
                       pitch(degrees(90));  // the board's x points down
    world.add_object("board", plane_patch{upright[1] - upright[0], across[1] - across[0]}, place);
}

}  // namespace gnomon::simulation::detail
