// SPDX-License-Identifier: BSL-1.0
/// @file
/// From known segments, labeled by hand or found by another library, to views that can be compared
/// with those of perceive_views(): heights and cells are the same, and those of a single object
/// have the same normals. Leave the walls of a room out of the points: they are not removed, and
/// would be neighbors of the objects that touch them.
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

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/filters/voxel_grid.hpp>
#include <gnomon/perception/detail/object_groups.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/recognition/view.hpp>
#include <gnomon/recognition/views_of.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::recognition {

namespace detail {

/// Of each cell, the label that most of its labeled points have, of equal ones the smallest;
/// `unlabeled` if none has one. O(n log n).
/// @param cell_of   of each point
/// @param label_of  likewise
[[nodiscard]] inline std::vector<std::int32_t> most_frequent_labels(
    const auto& cell_of, std::span<const std::int32_t> label_of, std::size_t cells) {
    std::vector<std::pair<std::size_t, std::int32_t>> labeled;
    for (std::size_t i = 0; i < label_of.size(); ++i)
        if (label_of[i] != unlabeled) labeled.emplace_back(cell_of[i], label_of[i]);
    std::ranges::sort(labeled);
    std::vector<std::int32_t> labels(cells, unlabeled);
    std::vector<std::size_t> most(cells, 0);
    for (std::size_t first = 0, last = 0; first < labeled.size(); first = last) {
        while (last < labeled.size() && labeled[last] == labeled[first]) ++last;
        const auto& [cell, label] = labeled[first];
        if (last - first <= most[cell]) continue;
        most[cell] = last - first;
        labels[cell] = label;
    }
    return labels;
}

}  // namespace detail

/// The views whose parts are given: segments with steps of at most `options.gap` between them
/// belong to one object. A cell belongs to the segment that most of its points are in, of equal
/// ones to the one of the smallest label.
/// @param points   any point range of n points [m]; seen from the origin without view points
/// @param parts    segments of the n points, to which part::segment refers. Points of none, at most
///                 the gap from a part, are the rest of its view
/// @param options  those of perceive_views(), of which min_points and max_length are not needed
/// @param run      the result does not depend on it
/// @return the views of at least `min_parts` parts, in the order of their first segments; without a
///         ground if none is given or found
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
    std::vector<std::int32_t> of_points;
    for (const point_index i : kept) of_points.push_back(parts.labels()[i]);
    auto labels = detail::most_frequent_labels(cells.of_point, of_points, cells.size());
    const auto seen = detail::surfaces_in(cells, options, team);  // of which the normals count
    return views_of(cells, seen.surface, segments(std::move(labels)),
                    {.gap = options.gap, .min_parts = options.min_parts, .ground = ground}, team);
}

}  // namespace gnomon::recognition
