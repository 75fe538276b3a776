// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a filter keeps. A filter returns the indices of the kept points, ascending; these functions
/// take everything that belongs to the points along with them, and invert the choice:
///
///     const auto kept = gnomon::remove_outliers(scan, gnomon::statistical_outliers{});
///     const gnomon::scan part = gnomon::subset(scan, kept);     // view points and fields as well
///     const auto part_labels = gnomon::subset(labels, kept);    // any vector
///     const auto outliers = gnomon::complement(kept, scan.size());
///
/// `subset_view` is the same without a copy. An organized image stays one if the points that a
/// filter removed become NaN instead:
///
///     for (const auto i : gnomon::complement(kept, scan.size())) scan.points[i].fill(NAN);
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>

namespace gnomon {

/// The elements of a vector at `indices`, in their order.
/// @throws std::invalid_argument  for an index out of range
/// Complexity: O(indices).
template <class T, class Allocator>
[[nodiscard]] std::vector<T> subset(const std::vector<T, Allocator>& values,
                                    std::span<const point_index> indices) {
    std::vector<T> chosen;
    chosen.reserve(indices.size());
    for (const point_index i : indices) {
        detail::require(i < values.size(), "subset: an index is out of range");
        chosen.push_back(values[i]);
    }
    return chosen;
}

/// The points of a scan at `indices`, in their order, with their view points and fields. An
/// organized image is one afterwards only if all its points are there in their order.
/// @throws std::invalid_argument  for an index out of range, or if the view points or a field are
///                                for another number of points
/// Complexity: O(indices) for each field.
[[nodiscard]] inline scan subset(const scan& all, std::span<const point_index> indices) {
    scan part;
    part.points = subset(all.points, indices);
    part.viewpoints = detail::viewpoints_of(all, indices);
    for (const scan::scalar_field& field : all.fields) {
        detail::require(field.values.size() == all.size(),
                        "subset: a field is for another number of points");
        part.fields.push_back({field.name, subset(field.values, indices), field.type});
    }
    bool is_whole = indices.size() == all.size();
    for (std::size_t i = 0; i < indices.size() && is_whole; ++i) is_whole = indices[i] == i;
    if (is_whole) part.width = all.width;
    return part;
}

/// The indices below `size` that are not among `kept`, ascending: the points that a filter removed,
/// those that are not finite among them.
/// @throws std::invalid_argument  unless `kept` ascends and stays below `size`, or if `size` is
/// 2^32
///                                or more
/// Complexity: O(size).
[[nodiscard]] inline std::vector<point_index> complement(std::span<const point_index> kept,
                                                         std::size_t size) {
    detail::require(size <= std::numeric_limits<point_index>::max(),
                    "complement: there must be fewer than 2^32 points");
    std::vector<point_index> removed;
    removed.reserve(size - std::min(size, kept.size()));
    std::size_t next = 0;
    for (const point_index i : kept) {
        detail::require(i >= next && i < size, "complement: indices must ascend and be in range");
        for (; next < i; ++next) removed.push_back(static_cast<point_index>(next));
        next = i + std::size_t{1};
    }
    for (; next < size; ++next) removed.push_back(static_cast<point_index>(next));
    return removed;
}

}  // namespace gnomon
