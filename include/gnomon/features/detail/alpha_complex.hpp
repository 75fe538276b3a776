// SPDX-License-Identifier: BSL-1.0
/// @file
/// The triangles of a Delaunay triangulation whose circumradius is small for their surroundings,
/// and the closed paths around them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/features/detail/planar_delaunay.hpp>

namespace gnomon::detail {

/// An alpha complex whose alpha varies with the local spacing of the points, in the units of their
/// coordinates.
class alpha_complex {
  public:
    using edge = planar_delaunay::edge;
    using path = std::vector<std::uint32_t>;  // origins of edges, triangles to the left

    /// O(n) after the triangulation.
    explicit alpha_complex(const planar_delaunay& d) : d_(d), is_kept_(d.edges(), false) {
        components_.reset(d.edges() / 2);
        keep_small_triangles();
    }

    /// The indices of the corners of each triangle, counterclockwise.
    [[nodiscard]] std::vector<std::array<point_index, 3>> triangles() const {
        std::vector<std::array<point_index, 3>> all;
        all.reserve(static_cast<std::size_t>(std::count(is_kept_.begin(), is_kept_.end(), true)) /
                    3);
        const auto index = [&](edge e) { return d_.points()[d_.origin(e)].index; };
        for (edge e = 0; e < d_.edges(); ++e) {
            if (!is_kept_[e]) continue;
            const auto [first, second, third] = sides_of(e);
            if (e < second && e < third) all.push_back({index(e), index(second), index(third)});
        }
        return all;
    }

    /// Calls found(path, component) for each closed path around triangles that are connected by
    /// edges. A path visits no point twice: where it touches itself, it is split.
    template <class Found>
    void for_each_path(Found&& found) {
        std::vector<bool> is_done(d_.edges(), false);
        std::vector<std::uint32_t> place(d_.points().size(), none);
        for (edge start = 0; start < d_.edges(); ++start) {
            if (is_done[start] || !is_boundary(start)) continue;
            const std::uint32_t component = components_.find(start / 2);
            path open;
            for (edge e = start; !is_done[e]; e = next_on_boundary(e)) {
                is_done[e] = true;
                add_to(open, d_.origin(e), place,
                       [&](const path& closed) { found(closed, component); });
            }
            for (const std::uint32_t v : open) place[v] = none;
            found(open, component);
        }
    }

  private:
    static constexpr std::uint32_t none = planar_delaunay::no_edge;

    [[nodiscard]] std::array<edge, 3> sides_of(edge e) const {
        const edge second = d_.next_about_left(e);
        return {e, second, d_.next_about_left(second)};
    }

    /// The smallest side of each triangle.
    [[nodiscard]] std::vector<edge> smallest_sides() const {
        std::vector<edge> smallest;
        smallest.reserve(d_.edges() / 3);
        for (edge e = 0; e < d_.edges(); ++e) {
            if (d_.is_removed(e)) continue;
            const auto [first, second, third] = sides_of(e);
            if (e < second && e < third && d_.has_triangle(e)) smallest.push_back(e);
        }
        return smallest;
    }

    [[nodiscard]] double squared_circumradius(const std::array<edge, 3>& sides) const {
        const planar_point& a = d_.points()[d_.origin(sides[0])];
        const planar_point& b = d_.points()[d_.origin(sides[1])];
        const planar_point& c = d_.points()[d_.origin(sides[2])];
        const auto squared = [](const planar_point& p, const planar_point& q) {
            return (p.x - q.x) * (p.x - q.x) + (p.y - q.y) * (p.y - q.y);
        };
        const double sine = 2.0 * signed_area(a, b, c);
        return squared(a, b) * (squared(b, c) / sine) * (squared(c, a) / sine);
    }

    void keep_small_triangles() {
        const std::vector<edge> triangles = smallest_sides();
        std::vector<double> radii(triangles.size());           // squared
        std::vector<double> largest(d_.points().size(), 0.0);  // about each point
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto sides = sides_of(triangles[t]);
            radii[t] = squared_circumradius(sides);
            for (const edge e : sides)
                largest[d_.origin(e)] = std::max(largest[d_.origin(e)], radii[t]);
        }
        const std::vector<double> limits = limits_of(std::move(largest));
        for (std::size_t t = 0; t < triangles.size(); ++t) {
            const auto [a, b, c] = sides_of(triangles[t]);
            const auto limit = [&](edge e) { return limits[d_.origin(e)]; };
            const auto [low, high] = std::minmax({limit(a), limit(b)});
            if (!std::isfinite(radii[t]) || radii[t] > std::clamp(limit(c), low, high)) continue;
            for (const edge e : {a, b, c}) is_kept_[e] = true;
            components_.unite(a / 2, b / 2);
            components_.unite(a / 2, c / 2);
        }
    }

    /// The square of alpha at each point.
    /// @param largest  squared circumradius of the triangles at each point
    [[nodiscard]] std::vector<double> limits_of(std::vector<double> largest) const {
        // pi density radius^2 of the triangles of random points is Gamma(2) (Miles 1970), and a
        // point has six. The largest of 10^6 triangles has 2.1 times the median of `largest`, and
        // 1.7 times its quantile 0.9.
        constexpr double from_median = 2.5 * 2.5;
        constexpr double from_high_quantile = 1.7 * 1.7;
        constexpr std::size_t smallest = 512;  // several lines of points 1/100 as far apart
        const std::size_t n = largest.size();
        const auto quantile = [&largest](double q, std::size_t begin, std::size_t end) {
            const auto at = [&](std::size_t i) {
                return largest.begin() + static_cast<std::ptrdiff_t>(i);
            };
            const auto i = static_cast<std::size_t>(q * static_cast<double>(end - begin - 1));
            std::nth_element(at(begin), at(begin + i), at(end));
            return largest[begin + i];
        };
        std::vector<double> limits(n);
        d_.for_each_cell(smallest, [&](std::size_t begin, std::size_t end) {
            const double limit = from_median * quantile(0.5, begin, end);
            for (std::size_t v = begin; v < end; ++v) limits[v] = limit;
        });
        // Where lines are wide for their distance, few points are at the gaps between them; those
        // on the border of the shape, about 6 sqrt(n) with an opening, have to be fewer.
        const double on_border = std::clamp(6.0 / std::sqrt(static_cast<double>(n)), 0.1, 0.5);
        const double least = from_high_quantile * quantile(1.0 - on_border, 0, n);
        for (double& limit : limits) limit = std::max(least, limit);
        return limits;
    }

    [[nodiscard]] bool is_boundary(edge e) const { return is_kept_[e] && !is_kept_[e ^ 1]; }

    /// The boundary edge after e around the triangles that are connected about the end of e.
    [[nodiscard]] edge next_on_boundary(edge e) const {
        edge next = d_.next_about_left(e);
        while (is_kept_[next ^ 1]) next = d_.next_about_left(next ^ 1);
        return next;
    }

    /// Appends v to a path; if v is on it, first closes and removes the path since.
    /// @param place  of each point on the open path
    template <class Found>
    static void add_to(path& open, std::uint32_t v, std::vector<std::uint32_t>& place,
                       Found&& found) {
        if (place[v] != none) {
            const auto since = open.begin() + static_cast<std::ptrdiff_t>(place[v]);
            const path closed(since, open.end());
            for (const std::uint32_t u : closed) place[u] = none;
            open.erase(since, open.end());
            found(closed);
        }
        place[v] = static_cast<std::uint32_t>(open.size());
        open.push_back(v);
    }

    const planar_delaunay& d_;
    std::vector<bool> is_kept_;  // the triangle on the left of each edge
    union_find components_;      // of edges, each one with its reverse
};

}  // namespace gnomon::detail
