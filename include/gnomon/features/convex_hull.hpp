// SPDX-License-Identifier: BSL-1.0
/// @file
/// The convex hull of a point set or segment: its extreme points, the triangles of its surface, its
/// volume and area. In no umbrella: include it by name.
///
///     const auto hull = gnomon::convex_hull::of(gnomon::subset_view(scan, parts[s]));
///     if (hull.shape == gnomon::hull_shape::solid) use(hull.volume, hull.triangles);
///
/// All decisions are exact, for the coordinates as they are: points are extreme, collinear or
/// coplanar without a tolerance. Klasing 2010, Sec. 3.5.3.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/detail/hull_simplex.hpp>
#include <gnomon/features/detail/local_points.hpp>
#include <gnomon/features/detail/orientation.hpp>
#include <gnomon/features/detail/planar_hull.hpp>
#include <gnomon/features/detail/quickhull.hpp>

namespace gnomon {

/// The dimension of a convex hull.
enum class hull_shape {
    none,    ///< no point is finite
    point,   ///< all points are equal
    line,    ///< all points are collinear
    planar,  ///< all points are coplanar
    solid    ///< a polyhedron
};

/// The convex hull of the finite points of a range.
struct convex_hull {
    hull_shape shape = hull_shape::none;  ///< its dimension
    /// The extreme points: ascending; of a planar hull in their order around it. Points on its
    /// edges or facets are not extreme; of points at one place the smallest index is.
    std::vector<point_index> vertices;
    /// The surface of a solid, counterclockwise seen from outside: indices of points.
    std::vector<std::array<point_index, 3>> triangles;
    double volume = 0.0;  ///< of a solid [m^3]; infinite if it overflows
    double area = 0.0;    ///< of the surface of a solid, or of one side of a planar hull [m^2]

    /// The convex hull of the finite points of a range.
    /// @param points      any point range of n points [m]
    /// @param projection  maps an element of the range to a point
    /// @throws std::invalid_argument  if n is 2^32 - 1 or more
    /// Complexity: O(n log n) for most sets, O(n) if few points are extreme. Coordinates below
    /// 1e-80 of the largest count as zero. Source: Barber, Dobkin and Huhdanpaa
    /// 1996 (detail/quickhull.hpp). It takes no execution: hulls of many segments may be computed
    /// on as many threads, and most points of one are discarded in a single pass.
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static convex_hull of(const R& points, Proj projection = {});
};

namespace detail {

/// The hull of exactly coplanar points, after a projection along a coordinate axis.
[[nodiscard]] inline convex_hull planar_hull_of(const local_points& p,
                                                const hull_simplex& simplex) {
    const int x = simplex.dropped == 0 ? 1 : 0;
    const int y = simplex.dropped == 2 ? 1 : 2;
    std::vector<planar_point> projected(p.positions.size());
    for (std::size_t i = 0; i < projected.size(); ++i)
        projected[i] = {p.positions[i][x], p.positions[i][y], static_cast<point_index>(i)};
    convex_hull hull;
    hull.shape = hull_shape::planar;
    const std::vector<planar_point> corners = planar_hull(std::move(projected));
    const Eigen::Vector3d& first = p.positions[corners.front().index];
    Eigen::Vector3d twice_area(0.0, 0.0, 0.0);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        hull.vertices.push_back(p.indices[corners[i].index]);
        if (i < 2) continue;
        const Eigen::Vector3d a = difference(p.positions[corners[i - 1].index], first);
        const Eigen::Vector3d b = difference(p.positions[corners[i].index], first);
        twice_area = combined(1.0, twice_area, 1.0, cross(a, b));
    }
    hull.area = 0.5 * length(twice_area) / p.scale / p.scale;
    return hull;
}

/// The hull of points of which four are not coplanar.
[[nodiscard]] inline convex_hull solid_hull_of(local_points& p, const hull_simplex& simplex) {
    const quickhull surface(p.positions, simplex.corners);
    const std::vector<std::uint32_t> extreme = surface.extreme_points();
    if (extreme.size() < surface.corner_count()) {
        p.keep(extreme);  // their hull has no other corners
        return solid_hull_of(p, hull_simplex(p.positions));
    }
    convex_hull hull;
    hull.shape = hull_shape::solid;
    const Eigen::Vector3d& first = p.positions[extreme.front()];
    surface.for_each_triangle([&](const hull_triangle& t) {
        hull.triangles.push_back({p.indices[t[0]], p.indices[t[1]], p.indices[t[2]]});
        const Eigen::Vector3d& a = p.positions[t[0]];
        const Eigen::Vector3d& b = p.positions[t[1]];
        const Eigen::Vector3d& c = p.positions[t[2]];
        hull.area += length(cross(difference(b, a), difference(c, a)));
        // Tetrahedra of one sign, so that no digits cancel.
        constexpr double certainty = 1e11;  // rounding
        hull.volume -= signed_volume(a, b, c, first, certainty);
    });
    hull.area = hull.area / 2.0 / p.scale / p.scale;
    constexpr double volumes_per_determinant = 6.0;  // formula: of a tetrahedron
    hull.volume = hull.volume / volumes_per_determinant / p.scale / p.scale / p.scale;
    for (const std::uint32_t i : extreme) hull.vertices.push_back(p.indices[i]);
    std::sort(hull.vertices.begin(), hull.vertices.end());
    return hull;
}

/// The hull of equal or collinear points: their lexicographic extremes.
[[nodiscard]] inline convex_hull thin_hull_of(const local_points& p, const hull_simplex& simplex) {
    convex_hull hull;
    if (simplex.count == 0) return hull;
    const std::uint32_t first = simplex.corners[0];
    std::uint32_t last = first;
    for (std::uint32_t i = 0; i < p.positions.size(); ++i)
        if (hull_simplex::precedes(p.positions[last], p.positions[i])) last = i;
    hull.shape = last == first ? hull_shape::point : hull_shape::line;
    hull.vertices = {p.indices[first], p.indices[last]};
    if (last == first) hull.vertices.pop_back();
    std::sort(hull.vertices.begin(), hull.vertices.end());
    return hull;
}

}  // namespace detail

template <class R, class Proj>
    requires point_range<R, Proj>
convex_hull convex_hull::of(const R& points, Proj projection) {
    detail::local_points p(position_view<R, Proj>(points, std::move(projection)));
    const detail::hull_simplex simplex(p.positions);
    if (simplex.count < 3) return detail::thin_hull_of(p, simplex);
    if (simplex.count == 3) return detail::planar_hull_of(p, simplex);
    return detail::solid_hull_of(p, simplex);
}

}  // namespace gnomon
