// SPDX-License-Identifier: BSL-1.0
/// @file
/// The walls of a scan, and the points that may belong to objects instead.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition::detail {

/// The walls of a scan, and the indices of the points that are not of these.
struct separated_walls {
    std::vector<wall> walls;
    std::vector<point_index> others;
};

/// Separates walls from other points. Surfaces that are longer than `max_length` [m] and not level,
/// as two tops of one height that touch are, have the planes of walls. Points of such a surface, or
/// of no surface, are of a wall within three deviations of the noise, or 1 cm, of its plane: the
/// back of a chair at a wall may be in one surface with it, but is not in its plane.
/// @param surface  of the n points, a `normal_range`
/// @param noise    of the points, along their rays [m]
/// Complexity: O(n) for each wall.
[[nodiscard]] inline separated_walls separate_walls(const auto& points, const auto& surface,
                                                    const segments& parts, double max_length,
                                                    const noise_curve& noise,
                                                    const Eigen::Vector3d& up) {
    constexpr double level = 0.9;  // chosen: cosine; within 26 degrees
    // Edges and curved walls, whose points are removed likewise, are not given as walls.
    constexpr double broad = 0.5;  // [m]; chosen: parts of walls between furniture
    constexpr double thick = 0.2;  // [m]; chosen: more than a board on a wall
    using gnomon::detail::certain_deviations, gnomon::detail::flatness;
    constexpr double narrowest = certain_deviations * flatness;  // [m]: as that of floors
    separated_walls result;
    std::vector<plane> planes;
    std::vector<char> is_wall(parts.size(), 0);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        const auto shape = segment_shape::of(points, surface, parts[s]);
        if (!shape.is_surface() || !(shape.frame.box_size.maxCoeff() > max_length)) continue;
        const Eigen::Vector3d& n = shape.normal;
        if (std::abs(gnomon::detail::dot(n, up)) > level) continue;
        is_wall[s] = 1;
        planes.push_back({n, gnomon::detail::dot(n, shape.frame.centroid)});
        if (shape.frame.box_size[1] >= broad && shape.frame.box_size[2] <= thick)
            result.walls.push_back({planes.back(), shape.frame.box()});
    }
    const auto is_in_wall = [&](std::size_t i) {
        const double sigma =
            noise.along(gnomon::detail::difference(points.points[i], points.viewpoints[i]));
        const double band = std::max(narrowest, gnomon::detail::most_deviations * sigma);
        return std::ranges::any_of(planes, [&](const plane& w) {
            return std::abs(w.signed_distance(points.points[i])) <= band;
        });
    };
    for (std::size_t i = 0; i < parts.labels().size(); ++i) {
        const std::int32_t label = parts.labels()[i];
        const bool is_elsewhere =
            label != unlabeled && is_wall[static_cast<std::size_t>(label)] == 0;
        if (is_elsewhere || !is_in_wall(i)) result.others.push_back(static_cast<point_index>(i));
    }
    return result;
}

}  // namespace gnomon::recognition::detail
