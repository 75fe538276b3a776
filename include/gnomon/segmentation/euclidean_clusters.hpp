// SPDX-License-Identifier: BSL-1.0
/// @file
/// Euclidean clusters: groups of points that chains of short steps connect, such as the objects
/// that remain when floor and ceiling are removed.
///
/// Klasing 2010, Sec. 4.2.3, Alg. 4.1. Exact: the connected components of the graph that joins
/// points at most r apart (the whole radius, no cap at k neighbors).
#pragma once

#include <cstddef>
#include <functional>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/components_within.hpp>
#include <gnomon/segmentation/detail/link_within.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of Alg. 4.1, with the thesis's values.
struct euclidean_clusters_options {
    double radius = 0.01;           ///< r, the largest gap within a segment [m]
    std::size_t min_points = 1000;  ///< n_min, smaller groups are noise
    /// The shortcut of the thesis: skips the search at points that were found as a neighbor. It may
    /// leave connected groups apart. Runs on one thread, and is no faster than the exact search.
    bool greedy = false;
};

/// The groups of points that chains of steps of at most `radius` connect.
///
/// @return the segments of at least `min_points` points, largest first
/// @throws std::invalid_argument  if the radius is negative, infinite or NaN
/// Complexity: O(n log n) whatever the radius, except where many points of two clusters are just
/// beyond it from each other; the same for greedy.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments euclidean_clusters(const R& points,
                                          const euclidean_clusters_options& options = {},
                                          const X& run = {}, Proj projection = {}) {
    detail::require(options.radius >= 0.0 && std::isfinite(options.radius),
                    "euclidean_clusters: the radius must be finite and not negative");
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    if (options.greedy) {
        detail::linker linker(index);
        linker.link_greedily([&](std::size_t) { return options.radius; },
                             [](std::size_t, const neighbor&) { return true; });
        return detail::segments_of(linker.labels(options.min_points));
    }
    return detail::numbered_segments_of(
        detail::components_within(index.tree(), options.radius, team), options.min_points);
}

}  // namespace gnomon
