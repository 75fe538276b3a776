// SPDX-License-Identifier: BSL-1.0
/// @file
/// The rectangle of smallest area around a convex polygon has a side on one of its edges (Freeman
/// and Shapira 1975). All edges are tried, with the four supporting corners carried along (rotating
/// calipers, Toussaint 1983).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// A rectangle in the plane: the points low[0] <= u . x <= high[0], low[1] <= v . x <= high[1] with
/// u = (c, s) and v = (-s, c).
struct planar_rectangle {
    double c = 1.0;
    double s = 0.0;
    std::array<double, 2> low{};
    std::array<double, 2> high{};

    [[nodiscard]] double area() const { return (high[0] - low[0]) * (high[1] - low[1]); }

    /// u . x or v . x.
    [[nodiscard]] double along(int axis, const Eigen::Vector2d& x) const {
        return axis == 0 ? c * x[0] + s * x[1] : c * x[1] - s * x[0];
    }
};

/// The smallest rectangle around a convex polygon: of equal areas that of the first edge; of two
/// corners the line between them, of one corner that point. O(h) for h corners, at least one.
/// @param corners  counterclockwise, none of them on the line between its neighbors
[[nodiscard]] inline planar_rectangle smallest_rectangle(std::span<const Eigen::Vector2d> corners) {
    const std::size_t n = corners.size();
    planar_rectangle best;
    double smallest = std::numeric_limits<double>::infinity();
    std::array<std::size_t, 3> support{};  // farthest along u, along v, and against u
    for (std::size_t edge = 0; edge < (n > 2 ? n : n - 1); ++edge) {
        const std::size_t next = edge + 1 < n ? edge + 1 : 0;
        const double x = corners[next][0] - corners[edge][0];
        const double y = corners[next][1] - corners[edge][1];
        const double length = std::hypot(x, y);
        planar_rectangle r;
        r.c = x / length;
        r.s = y / length;
        const std::array<planar_rectangle, 3> turned{r, planar_rectangle{-r.s, r.c, {}, {}},
                                                     planar_rectangle{-r.c, -r.s, {}, {}}};
        std::size_t start = next;
        for (std::size_t k = 0; k < 3; ++k) {  // they follow each other around the polygon
            if (edge == 0) support[k] = start;
            std::size_t& at = support[k];
            for (std::size_t steps = 0; steps < n; ++steps) {
                const std::size_t after = at + 1 < n ? at + 1 : 0;
                if (turned[k].along(0, corners[after]) < turned[k].along(0, corners[at])) break;
                at = after;
            }
            start = at;
        }
        r.high = {r.along(0, corners[support[0]]), r.along(1, corners[support[1]])};
        r.low = {r.along(0, corners[support[2]]), r.along(1, corners[edge])};
        if (r.area() < smallest) {
            smallest = r.area();
            best = r;
        }
    }
    for (int axis = 0; axis < 2; ++axis) {  // of all corners, in spite of rounding
        const auto a = static_cast<std::size_t>(axis);
        best.low[a] = best.high[a] = best.along(axis, corners[0]);
        for (const Eigen::Vector2d& x : corners) {
            best.low[a] = std::min(best.low[a], best.along(axis, x));
            best.high[a] = std::max(best.high[a], best.along(axis, x));
        }
    }
    return best;
}

}  // namespace gnomon::detail
