// SPDX-License-Identifier: BSL-1.0
/// @file
/// The convex outline of a planar segment: the convex hull of its points, projected to its plane as
/// `project_to_plane` does.
/// In no umbrella: include it by name.
///
///     const auto wall = gnomon::convex_polygon::of(gnomon::subset_view(scan, parts[s]), plane);
///     draw(wall.corner(0), wall.corner(1));  // counterclockwise seen from the side of the normal
///
/// Klasing 2010, Sec. 3.5.3.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/detail/planar_hull.hpp>
#include <gnomon/features/detail/planar_projection.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon {

/// A convex polygon in a plane. Without any finite point it has no corner, with all points at one
/// place one, with collinear points the two ends; its area is then zero.
struct convex_polygon {
    Eigen::Vector3d origin{0.0, 0.0, 0.0};                   ///< on the plane, near the polygon [m]
    Eigen::Matrix3d axes = detail::diagonal(1.0, 1.0, 1.0);  ///< x, y and normal of the plane
    /// The corners counterclockwise, along x and y from the origin [m].
    std::vector<Eigen::Vector2d> outline;
    std::vector<point_index> vertices;  ///< the points that were projected to the corners
    double area = 0.0;                  ///< [m^2]

    /// Corner i [m].
    [[nodiscard]] Eigen::Vector3d corner(std::size_t i) const {
        return detail::combined(1.0, origin, outline[i][0], detail::column(axes, 0), outline[i][1],
                                detail::column(axes, 1));
    }

    /// The convex hull of the projections of the finite points to a plane: along their rays where
    /// view points are known.
    /// @param points      any point range of n points [m]
    /// @param plane       e.g. that of a segment; its normal is the third axis
    /// @param projection  maps an element of the range to a point
    /// @throws std::invalid_argument  if n is 2^32 - 1 or more, the view points are for another
    ///                                number of points, or unless the normal is of unit length
    /// Complexity: O(n log n), O(n) if most points are in the interior. Of points projected to one
    /// place the smallest index is a vertex. Source: Andrew 1979 (detail/planar_hull.hpp).
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static convex_polygon of(const R& points, const gnomon::plane& plane,
                                           Proj projection = {});
};

namespace detail {

/// Sets the outline to the hull of the points x, y [m].
inline void set_outline(convex_polygon& polygon, std::vector<planar_point> points) {
    double largest = 0.0;
    for (const planar_point& p : points)
        largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    const double scale = largest > 0.0 ? power_to_one(largest) : 1.0;  // products do not overflow
    for (planar_point& p : points) p = {scale * p.x, scale * p.y, p.index};
    const std::vector<planar_point> corners = planar_hull(std::move(points));
    for (std::size_t i = 0; i < corners.size(); ++i) {
        polygon.vertices.push_back(corners[i].index);
        polygon.outline.emplace_back(corners[i].x / scale, corners[i].y / scale);
        if (i > 1) polygon.area += signed_area(corners[0], corners[i - 1], corners[i]);
    }
    polygon.area = polygon.area / 2.0 / scale / scale;
}

}  // namespace detail

template <class R, class Proj>
    requires point_range<R, Proj>
convex_polygon convex_polygon::of(const R& points, const gnomon::plane& plane, Proj projection) {
    detail::require_hesse(plane);
    const position_view<R, Proj> p(points, std::move(projection));
    convex_polygon polygon;
    const detail::planar_axes planar(plane);
    polygon.axes = detail::from_columns(planar.x, planar.y, plane.normal);
    std::size_t first = 0;
    while (first < p.size() && !is_finite(p[first])) ++first;
    if (first == p.size()) return polygon;
    polygon.origin =
        detail::combined(1.0, p[first], -plane.signed_distance(p[first]), plane.normal);
    detail::set_outline(polygon, planar.projected(points, p, p[first]));
    return polygon;
}

}  // namespace gnomon
