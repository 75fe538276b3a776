// SPDX-License-Identifier: BSL-1.0
/// @file
/// The gap between two segments: what was seen along lines across it, and whether that is evidence
/// for one surface.
#pragma once

#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>

namespace gnomon::detail {

/// A gap between two segments, as `considered_gap`.
struct examined_gap {
    region_pair sides;
    scratch<boundary_pair> lines;
    observation_count seen = {};
    bool is_closed = false;  ///< by what was seen
    bool merged = false;     ///< both sides are one segment at the end
};

/// A segment next to a gap: its number and its points, some, all finite.
struct gap_side {
    point_index number;
    std::span<const point_index> points;

    [[nodiscard]] Eigen::Vector3d centroid(const spatial_index& of) const {
        Eigen::Vector3d sum(0.0, 0.0, 0.0);
        const Eigen::Vector3d first = of[points.front()];
        for (const point_index i : points) sum = combined(1.0, sum, 1.0, difference(of[i], first));
        return combined(1.0, first, 1.0 / static_cast<double>(points.size()), sum);
    }
};

/// Examines the gap between two segments. It is closed if it is narrow, or more of the lines across
/// it are in favor of that than against it; unless one of them alone keeps it open.
/// @param options  `merge_occluded_options`, which are valid
/// Complexity: O(points of both * boundary pairs), and O(view points) for each pixel of the lines.
template <merge_policy M>
[[nodiscard]] examined_gap gap_between(const gap_side& a, const gap_side& b,
                                       const spatial_index& points, const visibility& visible,
                                       const M& policy, const auto& options) {
    examined_gap gap{{a.number, b.number}, {}};
    append_boundary_pairs(gap.lines, points, a.points, b.points,
                          {a.centroid(points), b.centroid(points)}, options.boundary_pairs);
    std::size_t in_favor = 0, against = 0;
    bool is_kept_open = false;
    for (const boundary_pair& line : gap.lines) {
        const Eigen::Vector3d v =
            combined(0.5, points.viewpoints[line.first], 0.5, points.viewpoints[line.second]);
        const observation_count seen = visible.between(points[line.first], points[line.second], v);
        gap.seen += seen;
        is_kept_open = is_kept_open || keeps_open(policy, seen);
        const verdict of_line = verdict_of(policy, seen);
        in_favor += of_line == verdict::in_favor ? 1 : 0;
        against += of_line == verdict::against ? 1 : 0;
    }
    const bool is_narrow = coplanar_distance(gap.lines) < options.max_gap;
    gap.is_closed = !is_kept_open && (is_narrow || in_favor > against);
    return gap;
}

}  // namespace gnomon::detail
