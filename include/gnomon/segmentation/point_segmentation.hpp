// SPDX-License-Identifier: BSL-1.0
/// @file
/// Groups of points that lie close together: what remains on its own once floor and ceiling are
/// gone.
///
/// Klasing 2010, Sec. 4.2.3, Alg. 4.1. Exact: the connected components of the graph that joins
/// points at most r apart (the whole radius, no cap at k neighbors).
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/components_within.hpp>
#include <gnomon/segmentation/detail/link_within.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of Alg. 4.1, with the thesis's values.
struct point_segmentation {
    double radius = 0.01;           ///< r, the largest gap within a segment [m]
    std::size_t min_points = 1000;  ///< n_min, smaller groups are noise
    /// The thesis's shortcut: skip the search at points that were found as somebody's neighbor. Now
    /// and then two groups stay apart that belong together. Runs on one thread, no faster than the
    /// exact way.
    bool greedy = false;
};

/// The groups of points that chains of steps of at most `radius` connect.
///
/// @return the segments of at least `min_points` points, largest first
/// @throws std::invalid_argument  if the radius is negative, infinite or NaN
/// Complexity: O(n log n), however many points are within the radius, unless many are hardly
/// farther than that from many of another group; greedy as well.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_points(const R& points, const point_segmentation& options = {},
                                      const X& run = {}, Proj projection = {}) {
    detail::require(options.radius >= 0.0 && std::isfinite(options.radius),
                    "segment_points: the radius must be finite and not negative");
    const position_view<R, Proj> p(points, projection);
    if (options.greedy) {
        const kd_tree tree(points, std::move(projection));
        detail::linker linker(p);
        linker.link_greedily(
            tree, [&](std::size_t) { return options.radius; },
            [](std::size_t, const neighbor&) { return true; });
        return linker.result(options.min_points);
    }
    union_find sets = detail::components_within(p, options.radius, run);
    return detail::segments_of(sets, options.min_points,
                               [&p](std::size_t i) { return is_finite(p[i]); });
}

}  // namespace gnomon
