// SPDX-License-Identifier: BSL-1.0
/// @file
/// From known segments to views that can be compared with those of perceive_views(): the segments
/// are labeled by hand, or found by another library, and heights, cells and normals are the same.
///
///     namespace rec = gnomon::recognition;
///     const auto views = rec::views_of_segments(scan, labeled, {.ground = floor});
///
/// Real scans are cut into other parts than simulated ones. To recognize objects whatever their
/// parts, an object_recognizer is to be given views of whole objects as one part, too:
///
///     const gnomon::segments whole(std::vector<std::int32_t>(scan.size(), 0));
///     const auto as_one = rec::views_of_segments(scan, whole, {.ground = gnomon::plane{},
///                                                              .gap = rec::infinite_gap});
///
/// In no umbrella: include it by name.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

/// The views whose parts are given: segments with steps of at most `options.gap` between them
/// belong to one object. A cell with points of several segments belongs to that of the last one.
/// @param points   any point range of n points [m]; seen from the origin without view points
/// @param parts    segments of the n points; those of floor, ceiling and walls are not to be parts.
///                 part::segment refers to these. Points of none count as the rest of a view
/// @param options  those of perceive_views(), of which min_points and max_length are not needed
/// @param run      the result does not depend on it
/// @throws std::invalid_argument  if points and segments differ in number, for options that are not
///                                valid, or what the steps throw for them
/// Complexity: O(n log n).
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<view> views_of_segments(const R& points, const segments& parts,
                                                  const perceive_views_options& options = {},
                                                  const X& run = {}, Proj projection = {}) {
    options.require_valid();
    gnomon::detail::require(parts.labels().size() == std::ranges::size(points),
                            "views_of_segments: points and segments differ in number");
    const auto& team = gnomon::detail::staying(run);
    std::optional<plane> ground;
    const auto kept = detail::seen_by_wide_beams(
        points, detail::between_floor_and_ceiling(points, options, ground, projection), options,
        team, projection);
    const auto cells = average_voxels(subset_view<R, Proj>(points, kept, projection),
                                      {.edge = options.cell}, team);
    constexpr std::size_t fewest = 4;  // formula: a plane and a residual
    if (cells.size() < fewest) return {};
    std::vector<std::int32_t> labels(cells.size(), unlabeled);
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const std::int32_t label = parts.labels()[kept[i]];
        if (label != unlabeled) labels[cells.of_point[i]] = label;
    }
    const auto seen = detail::surfaces_in(cells, options, team);  // of which the normals count
    return views_of(cells, seen.surface, segments(std::move(labels)),
                    {.gap = options.gap, .min_parts = options.min_parts, .ground = ground}, team);
}

}  // namespace gnomon::recognition
