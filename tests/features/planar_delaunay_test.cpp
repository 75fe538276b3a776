// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/features/detail/planar_delaunay.hpp>
#include <gnomon/features/detail/planar_hull.hpp>

namespace {

using gnomon::detail::planar_delaunay;
using gnomon::detail::planar_point;
using integer = std::int64_t;

integer double_area(const planar_point& a, const planar_point& b, const planar_point& c) {
    return (integer(b.x) - integer(a.x)) * (integer(c.y) - integer(a.y)) -
           (integer(b.y) - integer(a.y)) * (integer(c.x) - integer(a.x));
}

/// Positive if p is within the circumcircle of a counterclockwise triangle; without rounding for
/// coordinates up to 10,000.
integer in_circle(const planar_point& a, const planar_point& b, const planar_point& c,
                  const planar_point& p) {
    std::array<std::array<integer, 3>, 3> row{};
    std::size_t r = 0;
    for (const planar_point* q : {&a, &b, &c}) {
        const integer x = integer(q->x) - integer(p.x), y = integer(q->y) - integer(p.y);
        row[r++] = {x, y, x * x + y * y};
    }
    const auto minor = [&](std::size_t i, std::size_t j) {
        return row[i][0] * row[j][1] - row[i][1] * row[j][0];
    };
    return minor(0, 1) * row[2][2] + minor(1, 2) * row[0][2] + minor(2, 0) * row[1][2];
}

std::vector<planar_point> random_integers(std::size_t n, std::uint64_t seed, double width,
                                          double height) {
    gnomon::random_stream random(seed);
    std::vector<planar_point> points;
    for (std::size_t i = 0; i < n; ++i) {
        const double x = std::floor(width * random.uniform());
        points.push_back(
            {x, std::floor(height * random.uniform()), static_cast<gnomon::point_index>(i)});
    }
    return points;
}

/// All circumcircles are empty, and the triangles are as many and as large as the hull says.
void expect_delaunay(const std::vector<planar_point>& points) {
    const planar_delaunay d(points);
    std::set<std::pair<double, double>> places;
    for (const planar_point& p : points) places.insert({p.x, p.y});
    ASSERT_EQ(d.points().size(), places.size());
    integer area = 0;
    std::size_t sides = 0;
    std::size_t on_hull = 0;
    for (planar_delaunay::edge e = 0; e < d.edges(); ++e) {
        if (d.is_removed(e)) continue;
        ASSERT_EQ(d.origin(d.next_about_left(e)), d.destination(e));
        ASSERT_EQ(d.origin(d.next_about_origin(e)), d.origin(e));
        if (!d.has_triangle(e)) {
            ++on_hull;
            continue;
        }
        ++sides;
        const planar_point& a = d.points()[d.origin(e)];
        const planar_point& b = d.points()[d.destination(e)];
        const planar_point& c = d.points()[d.destination(d.next_about_left(e))];
        ASSERT_GT(double_area(a, b, c), 0);
        area += double_area(a, b, c);
        for (const planar_point& p : d.points()) ASSERT_LE(in_circle(a, b, c, p), 0);
    }
    const auto hull = gnomon::detail::planar_hull(points);
    integer hull_area = 0;
    for (std::size_t i = 2; i < hull.size(); ++i)
        hull_area += double_area(hull[0], hull[i - 1], hull[i]);
    EXPECT_EQ(area, 3 * hull_area);
    EXPECT_EQ(sides + on_hull, 2 * (3 * places.size() - 3 - on_hull));  // Euler; collinear: both 0
}

TEST(planar_delaunay, has_empty_circles) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE(seed);
        expect_delaunay(random_integers(3 + seed, seed, 10'000, 10'000));
        expect_delaunay(random_integers(3 + seed, seed, 12, 9));      // ties, duplicates
        expect_delaunay(random_integers(3 + seed, seed, 10'000, 3));  // lines
    }
}

TEST(planar_delaunay, of_collinear_points_has_no_triangle) {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {2, 3}, {1, -2}}) {
        std::vector<planar_point> line;
        for (const int i : {4, 1, 7, 7, 0, 2, 9, 3, 4})
            line.push_back({1.0 * i * dx, 1.0 * i * dy, gnomon::point_index(line.size())});
        const planar_delaunay d(line);
        EXPECT_EQ(d.points().size(), 7u);
        EXPECT_EQ(d.edges(), 12u);
        for (planar_delaunay::edge e = 0; e < d.edges(); ++e) EXPECT_FALSE(d.has_triangle(e));
        for (const planar_point& p : d.points())
            if (p.x == 4.0 * dx && p.y == 4.0 * dy) {
                EXPECT_EQ(p.index, 0u);  // the first at this place
            }
    }
    EXPECT_EQ(planar_delaunay({}).edges(), 0u);
    EXPECT_EQ(planar_delaunay({{1, 1, 0}, {1, 1, 1}}).edges(), 0u);
}

/// Edges that are removed are used again: their number is that of the triangulation, below 6 n.
TEST(planar_delaunay, has_no_more_edges_than_a_triangulation) {
    for (const std::size_t n : {2u, 13u, 1000u}) {
        std::vector<gnomon::detail::planar_point> points;
        gnomon::random_stream random(n);
        for (gnomon::point_index i = 0; i < n; ++i) {
            const double x = std::floor(1e9 * random.uniform());
            points.push_back({x, std::floor(1e9 * random.uniform()), i});
        }
        EXPECT_LE(planar_delaunay(points).edges(), 6 * n);
    }
}

}  // namespace
