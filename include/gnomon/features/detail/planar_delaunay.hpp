// SPDX-License-Identifier: BSL-1.0
/// @file
/// The Delaunay triangulation of points in a plane by divide and conquer (Guibas and Stolfi 1985,
/// Primitives for the manipulation of general subdivisions and the computation of Voronoi
/// diagrams), across the larger extent (Dwyer 1987: x and y in turn). Coordinates are integers, so
/// that their differences, and all signs, are exact.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gnomon/features/detail/planar_hull.hpp>
#include <gnomon/features/detail/planar_places.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// A triangulation as cycles of directed edges about their origins: edge e ^ 1 is e reversed.
class planar_delaunay {
  public:
    using edge = std::uint32_t;
    static constexpr edge no_edge = std::numeric_limits<edge>::max();

    /// @param points  with integers up to 2^33 in magnitude as coordinates, less than 2^28
    /// Of points at one place the smallest index is kept. O(n log n).
    explicit planar_delaunay(std::vector<planar_point> points) : points_(std::move(points)) {
        sort_places(points_);
        if (points_.size() < 2) return;
        edges_.reserve(6 * points_.size());  // at most, at any time
        triangulate(0, points_.size());
    }

    /// The different points; origins refer to them.
    [[nodiscard]] const std::vector<planar_point>& points() const { return points_; }

    /// Calls visit(begin, end) for cells of the points, which are halved across their larger extent
    /// as long as both halves have `least` points.
    template <class Visit>
    void for_each_cell(std::size_t least, const Visit& visit) const {
        visit_cells(0, points_.size(), least, visit);
    }

    /// The number of directed edges, with those that were removed.
    [[nodiscard]] edge edges() const { return static_cast<edge>(edges_.size()); }
    [[nodiscard]] bool is_removed(edge e) const { return edges_[e].next == no_edge; }

    [[nodiscard]] std::uint32_t origin(edge e) const { return edges_[e].origin; }
    [[nodiscard]] std::uint32_t destination(edge e) const { return edges_[e ^ 1].origin; }

    /// The next edge counterclockwise about the origin of e.
    [[nodiscard]] edge next_about_origin(edge e) const { return edges_[e].next; }

    /// The next edge counterclockwise about the face on the left of e.
    [[nodiscard]] edge next_about_left(edge e) const { return edges_[e ^ 1].previous; }

    /// Whether the face on the left of e is a triangle, and not the outer face.
    [[nodiscard]] bool has_triangle(edge e) const {
        const edge second = next_about_left(e);
        const edge third = next_about_left(second);
        return next_about_left(third) == e && is_left(origin(third), e);
    }

  private:
    struct outer_edges {
        edge left;   // out of the leftmost point, with the hull on its left
        edge right;  // out of the rightmost point, with the hull on its right
    };

    struct directed_edge {
        std::uint32_t origin;
        edge next, previous;  // about the origin
    };

    /// Whether a is left of b; below, where the plane is turned by a right angle. Those equal in
    /// one coordinate are ordered by the other, as if the plane were turned by a little more or
    /// less.
    [[nodiscard]] static bool is_before(const planar_point& a, const planar_point& b,
                                        bool is_turned) {
        if (is_turned) return a.y != b.y ? a.y < b.y : a.x < b.x;
        return a.x != b.x ? a.x < b.x : a.y < b.y;
    }

    [[nodiscard]] double area(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
        return signed_area(points_[a], points_[b], points_[c]);
    }
    [[nodiscard]] bool is_left(std::uint32_t p, edge e) const {
        return area(p, origin(e), destination(e)) > 0.0;
    }
    [[nodiscard]] bool is_right(std::uint32_t p, edge e) const {
        return area(p, destination(e), origin(e)) > 0.0;
    }
    /// Whether p lies within the circumcircle of the counterclockwise triangle (a, b, c).
    [[nodiscard]] bool is_within(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                 std::uint32_t p) const {
        const planar_point& o = points_[a];
        const auto from = [&o](const planar_point& q) {
            return planar_point{q.x - o.x, q.y - o.y, q.index};
        };
        return inverted_orientation(from(points_[b]), from(points_[p]), from(points_[c])) > 0;
    }

    edge add(std::uint32_t from, std::uint32_t to) {
        edge e = edges();
        if (free_ != no_edge)
            e = std::exchange(free_, edges_[free_].previous);
        else
            edges_.resize(edges_.size() + 2);
        edges_[e] = {from, e, e};
        edges_[e ^ 1] = {to, e ^ 1, e ^ 1};
        return e;
    }
    /// Joins the cycles about the origins of a and b, or splits their common one.
    void splice(edge a, edge b) {
        std::swap(edges_[a].next, edges_[b].next);
        edges_[edges_[a].next].previous = a;
        edges_[edges_[b].next].previous = b;
    }
    /// Adds an edge from the destination of a to the origin of b, which have one left face.
    edge connect(edge a, edge b) {
        const edge after = next_about_left(a);
        const edge e = add(destination(a), origin(b));
        splice(e, after);
        splice(e ^ 1, b);
        return e;
    }
    void remove(edge e) {
        splice(e, edges_[e].previous);
        splice(e ^ 1, edges_[e ^ 1].previous);
        edges_[e].next = edges_[e ^ 1].next = no_edge;
        edges_[e].previous = std::exchange(free_, e);
    }

    outer_edges triangulate(std::size_t begin, std::size_t end) {
        const auto at = [&](std::size_t i) {
            return points_.begin() + static_cast<std::ptrdiff_t>(i);
        };
        constexpr std::size_t few = 12;  // performance only
        const bool is_turned = end - begin > few && planar_box(at(begin), at(end)).is_upright();
        const auto before = [&](const planar_point& a, const planar_point& b) {
            return is_before(a, b, is_turned);
        };
        if (end - begin <= few) {
            std::sort(at(begin), at(end), before);
            return triangulate_sorted(begin, end);
        }
        const std::size_t middle = middle_of(begin, end);
        std::nth_element(at(begin), at(middle), at(end), before);
        const edge lower = triangulate(begin, middle).left;
        const edge upper = triangulate(middle, end).left;
        return merged(extremes(lower, is_turned), extremes(upper, is_turned));
    }

    /// A few points from left to right.
    outer_edges triangulate_sorted(std::size_t begin, std::size_t end) {
        const std::size_t count = end - begin;
        if (count > 3) {
            const std::size_t middle = begin + count / 2;
            const outer_edges left = triangulate_sorted(begin, middle);
            return merged(left, triangulate_sorted(middle, end));
        }
        const auto first = static_cast<std::uint32_t>(begin);
        const edge a = add(first, first + 1);
        if (count == 2) return {a, a ^ 1};
        const edge b = add(first + 1, first + 2);
        splice(a ^ 1, b);
        const double turn = area(first, first + 1, first + 2);
        if (turn == 0.0) return {a, b ^ 1};
        const edge c = connect(b, a);
        return turn > 0.0 ? outer_edges{a, b ^ 1} : outer_edges{c ^ 1, c};
    }

    /// The outer edges in another direction, by a walk around the hull.
    /// @param start  an edge with the hull on its left
    [[nodiscard]] outer_edges extremes(edge start, bool is_turned) const {
        outer_edges found{start, start ^ 1};
        edge e = start;
        do {
            if (is_before(points_[origin(e)], points_[origin(found.left)], is_turned))
                found.left = e;
            if (is_before(points_[origin(found.right)], points_[destination(e)], is_turned))
                found.right = e ^ 1;
            e = next_about_left(e ^ 1) ^ 1;
        } while (e != start);
        return found;
    }

    /// Zips two triangulations together, from the lower common tangent upwards.
    outer_edges merged(outer_edges left, outer_edges right) {
        edge from = left.right;
        edge to = right.left;
        for (;;) {
            if (is_left(origin(to), from))
                from = next_about_left(from);
            else if (is_right(origin(from), to))
                to = next_about_origin(to ^ 1);
            else
                break;
        }
        edge base = connect(to ^ 1, from);
        if (origin(from) == origin(left.left)) left.left = base ^ 1;
        if (origin(to) == origin(right.right)) right.right = base;
        for (;;) {
            const edge a = candidate(base, next_about_origin(base ^ 1), &directed_edge::next);
            const edge b = candidate(base, edges_[base].previous, &directed_edge::previous);
            const bool a_is_above = is_right(destination(a), base);
            const bool b_is_above = is_right(destination(b), base);
            if (!a_is_above && !b_is_above) return {left.left, right.right};
            const bool take_b = !a_is_above || (b_is_above && is_within(destination(a), origin(a),
                                                                        origin(b), destination(b)));
            base = take_b ? connect(b, base ^ 1) : connect(base ^ 1, a ^ 1);
        }
    }

    /// Removes edges that the next point above the base refutes.
    /// @param around  next or previous, the direction of search about an end of the base
    edge candidate(edge base, edge e, edge directed_edge::*around) {
        for (;;) {
            const edge after = edges_[e].*around;
            const bool is_last = (after ^ base) < 2;  // the base itself: no arithmetic needed
            if (is_last || !is_right(destination(e), base) ||
                !is_within(destination(base), origin(base), destination(e), destination(after)))
                return e;
            remove(e);
            e = after;
        }
    }

    std::vector<planar_point> points_;
    std::vector<directed_edge> edges_;
    edge free_ = no_edge;  // the last edge that was removed; `previous` is the one before
};

}  // namespace gnomon::detail
