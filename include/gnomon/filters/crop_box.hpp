// SPDX-License-Identifier: BSL-1.0
/// @file
/// Crops a cloud to a box: one along the coordinate axes, given by its least and greatest
/// coordinates, or one in any orientation. `complement` gives the points outside. An index finds
/// the points of a small box without reading the others.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {
namespace detail {

/// The indices of the finite points that `contains` accepts, ascending.
/// @param around  a box along the axes outside which it accepts none
template <class R, class Proj>
[[nodiscard]] std::vector<point_index> points_within(const R& points, Proj projection,
                                                     const leaf_box& around, auto&& contains) {
    std::vector<point_index> kept;
    if constexpr (std::same_as<R, spatial_index> && std::same_as<Proj, std::identity>) {
        const leaf_tree& tree = points.tree();
        if (tree.size() == 0) return kept;
        tree.for_each_leaf_near(around, 0.0, [&](std::size_t leaf, const leaf_box&) {
            const std::size_t begin = leaf * leaf_tree::leaf_size;
            const std::size_t end = std::min(begin + leaf_tree::leaf_size, tree.size());
            for (std::size_t place = begin; place < end; ++place) {
                const auto p = tree.position(place);
                if (contains(Eigen::Vector3d(p[0], p[1], p[2])))
                    kept.push_back(tree.index()[place]);
            }
        });
        std::sort(kept.begin(), kept.end());
    } else {
        const position_view<R, Proj> p(points, std::move(projection));
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d x = p[i];
            if (is_finite(x) && contains(x)) kept.push_back(static_cast<point_index>(i));
        }
    }
    return kept;
}

/// A box along the axes that holds an oriented one, whatever the rounding of either. Its axes need
/// not be exactly orthonormal: the vector of given products with them is a sum of the reciprocal
/// vectors, which are their cross products over the determinant.
[[nodiscard]] inline leaf_box box_around(const oriented_box& box) {
    constexpr double slack = 1e-5;      // numerical: determinants are above 1 - 2e-6
    constexpr double rounding = 1e-15;  // numerical: some units in the last place
    leaf_box around{};
    for (int a = 0; a < 3; ++a) {
        double reach = rounding * std::abs(box.center[a]);
        for (int b = 0; b < 3; ++b) {
            const int a1 = (a + 1) % 3, a2 = (a + 2) % 3, b1 = (b + 1) % 3, b2 = (b + 2) % 3;
            const double p = box.axes(a1, b1) * box.axes(a2, b2);
            const double q = box.axes(a1, b2) * box.axes(a2, b1);
            const double share = std::abs(p - q) + rounding * (std::abs(p) + std::abs(q));
            if (share > 0.0) reach += 0.5 * (1.0 + slack) * share * box.lengths[b];
            if (std::isfinite(box.lengths[b])) reach += rounding * box.lengths[b];
        }
        around.low[static_cast<std::size_t>(a)] = box.center[a] - reach;
        around.high[static_cast<std::size_t>(a)] = box.center[a] + reach;
    }
    return around;
}

}  // namespace detail

/// The indices of the points in a box along the axes, its surface included, ascending. Points that
/// are not finite are left out.
///
/// @param points      any point range of n points [m], or an index of them
/// @param low         the least coordinates of the box [m]; minus infinity where it has no end
/// @param high        the greatest coordinates of the box [m]; infinity where it has no end
/// @param projection  maps an element of the range to a point
/// @return the indices of the points in the box, for `subset`
/// @throws std::invalid_argument  if a coordinate of `low` is greater than that of `high`, or NaN
/// Complexity: O(n); with an index about O(log n + m log m) for m points in the box.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> crop_box(const R& points, const Eigen::Vector3d& low,
                                                const Eigen::Vector3d& high, Proj projection = {}) {
    for (int a = 0; a < 3; ++a)
        detail::require(low[a] <= high[a], "crop_box: low must not be above high, or NaN");
    const auto contains = [&](const Eigen::Vector3d& x) {
        return low[0] <= x[0] && x[0] <= high[0] && low[1] <= x[1] && x[1] <= high[1] &&
               low[2] <= x[2] && x[2] <= high[2];
    };
    const detail::leaf_box box{{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    return detail::points_within(points, std::move(projection), box, contains);
}

/// The indices of the points in an oriented box, its surface included up to rounding, ascending.
/// Points that are not finite are left out.
///
/// @param points      any point range of n points [m], or an index of them
/// @param box         its lengths may be infinite, and its axes off by 1e-6
/// @param projection  maps an element of the range to a point
/// @return the indices of the points in the box, for `subset`; those of an index are the same
/// @throws std::invalid_argument  unless the center of the box is finite, its lengths are not
///                                negative or NaN, and its axes are orthonormal
/// Complexity: O(n); with an index about O(log n + m log m) for m points in the smallest box along
/// the coordinate axes around it, which may be much larger.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> crop_box(const R& points, const oriented_box& box,
                                                Proj projection = {}) {
    detail::require_valid(box);
    return detail::points_within(points, std::move(projection), detail::box_around(box),
                                 [&](const Eigen::Vector3d& x) { return box.contains(x); });
}

}  // namespace gnomon
