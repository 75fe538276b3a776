// SPDX-License-Identifier: BSL-1.0
/// @file
/// From segments to views: segments whose nearest points are at most a gap apart belong to one
/// object. Klasing 2010, Sec. 5.5.1.
///
///     const auto views = gnomon::recognition::views_of(scan, surface, parts, {.ground = floor});
///
/// If the scan shows one object only, `{.gap = infinite_gap}` makes one view of all segments.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/recognition/detail/view_builder.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/segmentation/euclidean_clusters.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// A gap by which all segments are one view.
inline constexpr double infinite_gap = std::numeric_limits<double>::infinity();

/// How segments are grouped. Klasing 2010, Sec. 5.5.1.
struct views_of_options {
    double gap = 0.10;          ///< largest distance of nearest points within a view [m]
    std::size_t min_parts = 2;  ///< views of fewer parts are dropped
    std::optional<plane> ground = std::nullopt;  ///< with its normal upwards
};

namespace detail {

/// The groups of segments whose nearest points are at most `gap` apart, as the smallest segment of
/// the group of each.
[[nodiscard]] inline gnomon::detail::union_find linked_segments(
    const auto& labeled, const segments& parts, std::span<const point_index> indices, double gap,
    const auto& run) {
    gnomon::detail::union_find groups(parts.size());
    const segments clusters = euclidean_clusters(labeled, {.radius = gap, .min_points = 1}, run);
    for (std::size_t c = 0; c < clusters.size(); ++c) {
        const auto label = [&](point_index i) {
            return static_cast<point_index>(parts.labels()[indices[i]]);
        };
        for (const point_index i : clusters[c]) groups.unite(label(clusters[c].front()), label(i));
    }
    return groups;
}

}  // namespace detail

/// The views in a scan.
///
/// Two segments belong to one view if a chain of segments connects them whose nearest points are at
/// most `gap` apart. Points without a segment belong to the `rest` of a view if their nearest point
/// with a segment is in it, and at most `gap` away. Segments that are no surface, of points on a
/// line for example, count as such points.
///
/// @param points   any point range of n points [m], or the `spatial_index` of them
/// @param surface  n surface elements with normals, such as the result of `estimate_normals`
/// @param parts    segments of the n points
/// @param options  gap, least number of parts, and the ground, without which features that depend
///                 on heights are refused
/// @param run      `sequential{}` or `threads{n}`; the result does not depend on it
/// @return the views of at least `min_parts` parts, in the order of their first segments
/// @throws std::invalid_argument  if points, surface and segments differ in number, the gap is
///                                negative or NaN, or the normal of the ground not of unit length
/// Complexity: O(n log n). Source: Klasing 2010, Sec. 5.5.1.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<view> views_of(const R& points, const Surface& surface,
                                         const segments& parts,
                                         const views_of_options& options = {}, const X& run = {},
                                         Proj projection = {}) {
    using gnomon::detail::require;
    require(parts.labels().size() == std::ranges::size(points),
            "views_of: points and segments differ in number");
    require(std::ranges::size(surface) == std::ranges::size(points),
            "views_of: points and normals differ in number");
    require(options.gap >= 0.0, "views_of: the gap must not be negative");
    if (options.ground) gnomon::detail::require_hesse(*options.ground);
    const auto& team = gnomon::detail::staying(run);
    const auto shapes = segment_shapes(points, surface, parts, team, projection);
    const position_view<R, Proj> position(points, projection);
    const detail::labeled_points labeled(position, parts, shapes);
    if (labeled.indices.empty()) return {};
    const bool is_one_view = !(options.gap < infinite_gap);
    spatial_index index;  // of the points with a part, if they are to be grouped
    gnomon::detail::union_find groups(parts.size());
    if (is_one_view) {
        for (std::size_t s = 1; s < parts.size(); ++s) groups.unite(0, static_cast<point_index>(s));
    } else {
        index.rebuild(subset_view<R, Proj>(points, labeled.indices, projection), team);
        groups = detail::linked_segments(index, parts, labeled.indices, options.gap, team);
    }

    detail::view_builder builder(position, parts, options.ground);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        if (shapes[s].is_surface())
            builder.add(groups.find(static_cast<point_index>(s)), s, shapes[s]);
    }
    if (options.ground) {
        for (const point_index i : labeled.others) {
            std::size_t nearest = 0;
            if (!is_one_view) {
                const auto found = index.nearest_within(position[i], 1, options.gap);
                if (found.empty()) continue;
                nearest = found.front().index;
            }
            const auto label = static_cast<point_index>(parts.labels()[labeled.indices[nearest]]);
            builder.add_rest(groups.find(label), i);
        }
    }
    return std::move(builder).views(options.min_parts);
}

}  // namespace gnomon::recognition
