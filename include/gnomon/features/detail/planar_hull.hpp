// SPDX-License-Identifier: BSL-1.0
/// @file
/// The convex hull of points in a plane: the monotone chain (Andrew 1979) of those points that are
/// not within the octagon of extreme points (Akl and Toussaint 1978). All signs are exact.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <gnomon/features/detail/orientation.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// Twice the area of the triangle (a, b, c), positive if it is counterclockwise.
[[nodiscard]] inline double signed_area(const planar_point& a, const planar_point& b,
                                        const planar_point& c) {
    return signed_area(a.x, a.y, b.x, b.y, c.x, c.y);
}

/// Removes points strictly within the polygon of the extreme points in eight directions.
inline void remove_inner_points(std::vector<planar_point>& points) {
    static constexpr std::array<std::array<double, 2>, 8> directions{
        {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}}};
    std::array<planar_point, 8> extreme;
    extreme.fill(points.front());
    for (const planar_point& p : points) {
        for (std::size_t d = 0; d < 8; ++d) {
            const double x = directions[d][0];
            const double y = directions[d][1];
            if (x * p.x + y * p.y > x * extreme[d].x + y * extreme[d].y) extreme[d] = p;
        }
    }
    std::vector<planar_point> polygon;
    for (const planar_point& p : extreme) {
        if (polygon.empty() || p.x != polygon.back().x || p.y != polygon.back().y)
            polygon.push_back(p);
    }
    if (polygon.size() > 1 && polygon.front().x == polygon.back().x &&
        polygon.front().y == polygon.back().y)
        polygon.pop_back();  // an edge of no length would keep all points
    std::erase_if(points, [&](const planar_point& p) {
        for (std::size_t i = 0; i < polygon.size(); ++i) {
            const planar_point& next = polygon[i + 1 < polygon.size() ? i + 1 : 0];
            if (!(signed_area(polygon[i], next, p) > 0.0)) return false;
        }
        return true;
    });
}

/// Sorts points by x, then y; of points at one place the smallest index is kept.
inline void sort_by_place(std::vector<planar_point>& points) {
    std::sort(points.begin(), points.end(), [](const planar_point& a, const planar_point& b) {
        if (a.x != b.x) return a.x < b.x;
        return a.y != b.y ? a.y < b.y : a.index < b.index;
    });
    const auto same_place = [](const planar_point& a, const planar_point& b) {
        return a.x == b.x && a.y == b.y;
    };
    points.erase(std::unique(points.begin(), points.end(), same_place), points.end());
}

/// The corners of the convex hull, counterclockwise from the lexicographically smallest; one for
/// equal points, two for collinear ones. Of equal points the smallest index is taken.
/// @param points  at least one, up to 1 in magnitude
/// Complexity: O(n log n), O(n) if most points are in the interior.
[[nodiscard]] inline std::vector<planar_point> planar_hull(std::vector<planar_point> points) {
    remove_inner_points(points);
    sort_by_place(points);
    if (points.size() < 3) return points;
    std::vector<planar_point> hull;
    const auto add = [&](const planar_point& p, std::size_t fixed) {
        while (hull.size() > fixed && !(signed_area(hull[hull.size() - 2], hull.back(), p) > 0.0))
            hull.pop_back();
        hull.push_back(p);
    };
    for (const planar_point& p : points) add(p, 1);
    const std::size_t lower = hull.size();
    for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
    hull.pop_back();  // the first again
    return hull;
}

}  // namespace gnomon::detail
