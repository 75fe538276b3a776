// SPDX-License-Identifier: BSL-1.0
/// @file
/// The rectangle of smallest area around a planar segment. In no umbrella: include it by name.
///
///     const auto outline = gnomon::convex_polygon::of(gnomon::subset_view(scan, parts[s]), plane);
///     const auto size = gnomon::minimum_area_rectangle(outline).lengths;  // of a table top [m]
#pragma once

#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/detail/smallest_rectangle.hpp>

namespace gnomon {

/// The rectangle of smallest area around a convex polygon, as a box without height: the first axis
/// is along the longer side, the third is the normal of the polygon, the third length is zero.
/// Around two corners it has one length, around one corner none; without a corner the box is at its
/// defaults. Of equal areas that at the first edge is taken.
/// @param polygon  e.g. that of a segment, [m]
/// @return the rectangle [m], in the plane of the polygon
/// Complexity: O(h) for h corners. Source: Freeman and Shapira 1975.
[[nodiscard]] inline oriented_box minimum_area_rectangle(const convex_polygon& polygon) {
    oriented_box box;
    if (polygon.outline.empty()) return box;
    const detail::planar_rectangle r = detail::smallest_rectangle(polygon.outline);
    const Eigen::Vector3d x = detail::column(polygon.axes, 0);
    const Eigen::Vector3d y = detail::column(polygon.axes, 1);
    Eigen::Vector3d u = detail::combined(r.c, x, r.s, y);
    Eigen::Vector3d v = detail::combined(-r.s, x, r.c, y);
    box.center = detail::combined(1.0, polygon.origin, 0.5 * (r.low[0] + r.high[0]), u,
                                  0.5 * (r.low[1] + r.high[1]), v);
    box.lengths = {r.high[0] - r.low[0], r.high[1] - r.low[1], 0.0};
    if (box.lengths[1] > box.lengths[0]) {
        std::swap(box.lengths[0], box.lengths[1]);
        u = std::exchange(v, detail::scaled(-1.0, u));
    }
    box.axes = detail::from_columns(u, v, detail::column(polygon.axes, 2));
    return box;
}

}  // namespace gnomon
