// SPDX-License-Identifier: BSL-1.0
/// @file
/// The outline of a planar segment with its holes: a wall with its doorway. In no umbrella: include
/// it by name.
///
///     const auto wall = gnomon::alpha_shape::of(gnomon::subset_view(scan, parts[s]), plane);
///     for (const auto& hole : wall.polygons[0].holes) draw(hole);  // indices of points, in order
///
/// It is a 2D alpha shape (Edelsbrunner, Kirkpatrick and Seidel 1983): the triangles of the
/// Delaunay triangulation whose circumradius is at most alpha, here 2.5 times the local spacing.
/// Scan lines far apart are connected, since the spacing is taken across them: it is the median,
/// over the points of a cell of 512 to 1023 points, of the largest circumradius about each. Alpha
/// is at least 1.7 times the quantile 0.9 of that radius over all points. Openings are found from
/// about 4 spacings of a grid of points in width, 2.5 to 3 distances of scan lines, 6 mean spacings
/// of scattered points.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/detail/alpha_complex.hpp>
#include <gnomon/features/detail/planar_projection.hpp>

namespace gnomon {

/// A region of a plane with corners at projected points. It is empty without three points that are
/// not collinear.
struct alpha_shape {
    /// One connected part. Its closed paths are simple polygons whose edges do not cross, but may
    /// meet at a corner; each begins at the smallest index.
    struct polygon {
        std::vector<point_index> outline;  ///< counterclockwise, from the side of the normal
        std::vector<std::vector<point_index>> holes;  ///< clockwise, the largest first
        double area = 0.0;                            ///< without the holes [m^2]
    };

    std::vector<polygon> polygons;                      ///< the largest first
    std::vector<std::array<point_index, 3>> triangles;  ///< of all polygons, counterclockwise
    double area = 0.0;                                  ///< of all polygons [m^2]

    /// The alpha shape of the projections of the finite points to a plane: along their rays where
    /// view points are known, as `project_to_plane` does.
    /// @param points      any point range of n points [m]
    /// @param plane       e.g. that of a segment
    /// @param projection  maps an element of the range to a point
    /// @throws std::invalid_argument  if n is 2^29 or more, the view points are for another number
    ///                                of points, or unless the normal is of unit length
    /// Complexity: O(n log n). Points that differ by less than 2^-32 of the extent are one, with
    /// the smallest index of them.
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] static alpha_shape of(const R& points, const gnomon::plane& plane,
                                        Proj projection = {});
};

namespace detail {

/// Rounds coordinates to integers up to 2^32 in magnitude.
/// @return of how many metres the reciprocal is the unit; 0 without two places
[[nodiscard]] inline double round_to_integers(std::vector<planar_point>& points) {
    double largest = 0.0;
    for (const planar_point& p : points)
        largest = std::max({largest, std::abs(p.x), std::abs(p.y)});
    if (!(largest > 0.0)) return 0.0;
    const double scale = 0x1p32 * power_to_one(largest);
    for (planar_point& p : points)
        p = {std::nearbyint(scale * p.x), std::nearbyint(scale * p.y), p.index};
    return scale;
}

/// A closed path as indices of points, from the smallest on, and its area.
struct closed_outline {
    std::vector<point_index> indices;
    double area = 0.0;            // positive if counterclockwise
    std::uint32_t component = 0;  // of the complex

    closed_outline(const std::vector<planar_point>& points, const alpha_complex::path& corners,
                   std::uint32_t part)
        : component(part) {
        const planar_point& first = points[corners[0]];
        for (std::size_t i = 0; i < corners.size(); ++i) {
            indices.push_back(points[corners[i]].index);
            if (i > 1) area += 0.5 * signed_area(first, points[corners[i - 1]], points[corners[i]]);
        }
        std::rotate(indices.begin(), std::min_element(indices.begin(), indices.end()),
                    indices.end());
    }

    /// Outlines first and in the order of their areas, then holes, the largest first.
    [[nodiscard]] friend bool operator<(const closed_outline& a, const closed_outline& b) {
        if ((a.area > 0.0) != (b.area > 0.0)) return a.area > 0.0;
        if (a.area != b.area) return std::abs(a.area) > std::abs(b.area);
        return a.indices.front() < b.indices.front();
    }
};

/// Each part of a complex as a polygon with its holes; areas in units of the coordinates.
[[nodiscard]] inline std::vector<alpha_shape::polygon> polygons_of(
    alpha_complex& complex, const std::vector<planar_point>& points) {
    std::vector<closed_outline> paths;
    complex.for_each_path([&](const alpha_complex::path& corners, std::uint32_t component) {
        paths.emplace_back(points, corners, component);
    });
    std::sort(paths.begin(), paths.end());
    std::vector<alpha_shape::polygon> polygons;
    std::map<std::uint32_t, std::size_t> polygon_of;  // of each component
    for (closed_outline& path : paths) {
        if (path.area > 0.0) {
            polygon_of[path.component] = polygons.size();
            polygons.push_back({std::move(path.indices), {}, path.area});
        } else {
            alpha_shape::polygon& outer = polygons[polygon_of[path.component]];
            outer.holes.push_back(std::move(path.indices));
            outer.area += path.area;
        }
    }
    std::stable_sort(polygons.begin(), polygons.end(),
                     [](const auto& a, const auto& b) { return a.area > b.area; });
    return polygons;
}

}  // namespace detail

template <class R, class Proj>
    requires point_range<R, Proj>
alpha_shape alpha_shape::of(const R& points, const gnomon::plane& plane, Proj projection) {
    detail::require_hesse(plane);
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(p.size() < std::size_t{1} << 29, "alpha_shape: 2^29 points or more");
    alpha_shape shape;
    // The smallest coordinates, so that the result does not depend on the order of the points.
    Eigen::Vector3d low(0.0, 0.0, 0.0);
    bool is_any = false;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const Eigen::Vector3d q = p[i];
        if (!is_finite(q)) continue;
        for (int a = 0; a < 3; ++a) low[a] = is_any ? std::min(low[a], q[a]) : q[a];
        is_any = true;
    }
    std::vector<detail::planar_point> projected =
        detail::planar_axes(plane).projected(points, p, low);
    std::erase_if(projected, [](const detail::planar_point& q) {
        return !std::isfinite(q.x) || !std::isfinite(q.y);  // the extent overflows
    });
    const double scale = detail::round_to_integers(projected);
    if (scale == 0.0) return shape;
    const detail::planar_delaunay triangulation(std::move(projected));
    detail::alpha_complex complex(triangulation);
    shape.polygons = detail::polygons_of(complex, triangulation.points());
    shape.triangles = complex.triangles();
    for (polygon& part : shape.polygons) {
        part.area = part.area / scale / scale;
        shape.area += part.area;
    }
    return shape;
}

}  // namespace gnomon
