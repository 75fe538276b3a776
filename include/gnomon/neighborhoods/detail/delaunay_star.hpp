// SPDX-License-Identifier: BSL-1.0
/// @file
/// The neighbors of one point, the origin, in the Delaunay triangulation of points in a plane,
/// without the triangulation: an inversion in a circle about the origin turns circles through it
/// into lines, so that empty circles become supporting lines, and the neighbors are the corners of
/// the convex hull of the inverted points. One angular sort and one Graham scan.
///
/// The hull's orientation predicate is, but for positive factors, the in-circle predicate of the
/// points themselves, so the inversion is never carried out, and all signs are exact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/expansion.hpp>

namespace gnomon::detail {

/// A point of the plane, relative to the origin of the star, and its index in the cloud.
struct planar_point {
    double x, y;
    point_index index;
};

/// The sign of the angle from a to b: 1 if b lies counterclockwise of a, 0 on the same line.
[[nodiscard]] inline int turn(const planar_point& a, const planar_point& b) {
    return sign_of_difference(a.x, b.y, a.y, b.x);
}

/// In which of the half-planes y > 0 or y = 0 < x (0) and the rest (1) a lies.
[[nodiscard]] inline int half_plane(const planar_point& a) {
    return a.y > 0.0 || (a.y == 0.0 && a.x > 0.0) ? 0 : 1;
}

/// The orientation of the inverted points a', b', c': 1 counterclockwise. It is the sign of the
/// determinant of the rows (x, y, x^2 + y^2). Where the triangle (0, a, c) is counterclockwise, 1
/// means that b lies within its circumcircle, -1 outside and 0 on it.
[[nodiscard]] inline int inverted_orientation(const planar_point& a, const planar_point& b,
                                              const planar_point& c) {
    const double ab = a.x * b.y;
    const double ba = a.y * b.x;
    const double bc = b.x * c.y;
    const double cb = b.y * c.x;
    const double ca = c.x * a.y;
    const double ac = c.y * a.x;
    const double aa = a.x * a.x + a.y * a.y;
    const double bb = b.x * b.x + b.y * b.y;
    const double cc = c.x * c.x + c.y * c.y;
    const double determinant = (bc - cb) * aa + (ca - ac) * bb + (ab - ba) * cc;
    const double magnitude = (std::abs(bc) + std::abs(cb)) * aa +
                             (std::abs(ca) + std::abs(ac)) * bb +
                             (std::abs(ab) + std::abs(ba)) * cc;
    constexpr double eps = std::numeric_limits<double>::epsilon();
    if (std::abs(determinant) > 8.0 * eps * magnitude) return determinant > 0.0 ? 1 : -1;

    const auto minor = [](const planar_point& p, const planar_point& q) {
        return exact_product(p.x, q.y) + exact_product(-p.y, q.x);
    };
    const auto square = [](const planar_point& p) {
        return exact_product(p.x, p.x) + exact_product(p.y, p.y);
    };
    return (minor(b, c) * square(a) + minor(c, a) * square(b) + minor(a, b) * square(c)).sign();
}

/// Whether a is nearer to the origin than b.
[[nodiscard]] inline bool is_nearer(const planar_point& a, const planar_point& b) {
    const double aa = a.x * a.x + a.y * a.y;
    const double bb = b.x * b.x + b.y * b.y;
    constexpr double eps = std::numeric_limits<double>::epsilon();
    if (std::abs(aa - bb) > 2.0 * eps * (aa + bb)) return aa < bb;
    return ((exact_product(a.x, a.x) + exact_product(a.y, a.y)) +
            (exact_product(-b.x, b.x) + exact_product(-b.y, b.y)))
               .sign() < 0;
}

/// The vectors and spans of planar points are template parameters below for one reason: only those
/// who search stars shall compile the sorting of them.
///
/// Sorts by direction, counterclockwise from the x axis; of those in one direction the nearest
/// first, then the smallest index. Points at the origin have no direction: there must be none.
template <class Points>
void sort_by_direction(Points&& points) {
    std::sort(points.begin(), points.end(), [](const planar_point& a, const planar_point& b) {
        const int ha = half_plane(a);
        const int hb = half_plane(b);
        if (ha != hb) return ha < hb;
        const int t = turn(a, b);
        if (t != 0) return t > 0;
        const double na = std::abs(a.x) + std::abs(a.y);  // in one direction any norm will do
        const double nb = std::abs(b.x) + std::abs(b.y);
        return na != nb ? na < nb : a.index < b.index;
    });
}

/// Turns points sorted by direction round until the widest gap, if half of the plane or more, lies
/// between the last and the first.
/// @return whether there is such a gap
template <class Points>
bool begin_after_gap(Points&& points) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        const std::size_t next = (i + 1) % points.size();
        const int t = turn(points[i], points[next]);
        const bool same_direction =
            t == 0 && next != 0 && half_plane(points[i]) == half_plane(points[next]);
        if (t > 0 || same_direction) continue;
        std::rotate(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(next),
                    points.end());
        return true;
    }
    return points.size() < 2;
}

/// Of points sorted by direction keeps those on the hull of the inverted ones: Graham's scan. The
/// first must be a corner, and be the next after the last, or the last be a corner, too.
template <class Points>
void keep_hull(Points& points, bool closed) {
    std::size_t kept = 0;
    const auto drop_inner = [&](const planar_point& next) {
        while (kept > 1 && inverted_orientation(points[kept - 2], points[kept - 1], next) < 0) {
            --kept;
        }
    };
    for (std::size_t i = 0; i < points.size(); ++i) {
        drop_inner(points[i]);
        points[kept++] = points[i];
    }
    if (closed) drop_inner(points.front());
    points.resize(kept);
}

/// Points on one empty circle with the origin could all be neighbors. The polygon that they make is
/// cut into a fan about its smallest index, whichever star looks at it.
template <class Points>
void keep_fan(point_index center, Points& points, bool closed) {
    const std::size_t n = points.size();
    const auto at = [&](std::size_t i) -> const planar_point& { return points[i < n ? i : 0]; };
    const std::size_t last = closed ? n : n - 1;
    std::size_t kept = 1;
    for (std::size_t begin = 0; begin < last;) {
        // The run begin, ..., end lies on one circle with the origin.
        std::size_t end = begin + 1;
        point_index smallest = std::min({center, at(begin).index, at(end).index});
        while (end < last && inverted_orientation(points[begin], at(end), at(end + 1)) == 0) {
            smallest = std::min(smallest, at(++end).index);
        }
        for (std::size_t i = begin + 1; i < end; ++i) {
            if (smallest == center || smallest == points[i].index) points[kept++] = points[i];
        }
        if (end < n) points[kept++] = points[end];
        begin = end;
    }
    points.resize(kept);
}

/// Reduces `points` about point number `center` at the origin to the neighbors of the origin,
/// counterclockwise. Points at the origin have no direction and are dropped; of points at one place
/// the smallest index stays. O(k log k).
/// @return whether the star is open, the origin being on the border of the points' hull; the first
///         neighbor is then the one from which the others lie counterclockwise
template <class Points>
[[nodiscard]] bool reduce_to_star(point_index center, Points& points) {
    std::erase_if(points, [](const planar_point& q) { return q.x == 0.0 && q.y == 0.0; });
    sort_by_direction(points);
    const auto hides = [](const planar_point& nearby, const planar_point& distant) {
        return half_plane(nearby) == half_plane(distant) && turn(nearby, distant) == 0;
    };
    points.erase(std::unique(points.begin(), points.end(), hides), points.end());
    if (points.empty()) return true;
    const bool open = begin_after_gap(points);
    if (!open) {  // the nearest point is a corner of the hull
        std::rotate(points.begin(), std::min_element(points.begin(), points.end(), is_nearer),
                    points.end());
    }
    keep_hull(points, !open);
    keep_fan(center, points, !open);
    return open;
}

/// The square of the largest circumradius of the triangles of a closed star: all circles lie within
/// twice its root about the origin.
[[nodiscard]] inline double largest_squared_circumradius(const std::vector<planar_point>& star) {
    double largest = 0.0;
    for (std::size_t i = 0; i < star.size(); ++i) {
        const planar_point& a = star[i];
        const planar_point& b = star[i + 1 < star.size() ? i + 1 : 0];
        const double dx = a.x - b.x;
        const double dy = a.y - b.y;
        const double double_area = a.x * b.y - a.y * b.x;
        const double sides =
            (a.x * a.x + a.y * a.y) * (b.x * b.x + b.y * b.y) * (dx * dx + dy * dy);
        largest = std::max(largest, sides / (4.0 * double_area * double_area));
    }
    return largest;
}

}  // namespace gnomon::detail
