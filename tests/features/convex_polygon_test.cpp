// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/plane.hpp>
#include <gnomon/features/convex_polygon.hpp>

namespace {

using gnomon::convex_polygon;
using gnomon::point_index;

/// Oracle: the neighbors of a corner on a hull are found by gift wrapping, in long double.
std::set<point_index> corners_by_gift_wrapping(const std::vector<Eigen::Vector2d>& p) {
    const auto turn = [&](std::size_t a, std::size_t b, std::size_t c) {
        using real = long double;
        return (real(p[b].x()) - p[a].x()) * (real(p[c].y()) - p[a].y()) -
               (real(p[b].y()) - p[a].y()) * (real(p[c].x()) - p[a].x());
    };
    std::size_t start = 0;
    for (std::size_t i = 0; i < p.size(); ++i)
        if (p[i].x() < p[start].x() || (p[i].x() == p[start].x() && p[i].y() < p[start].y()))
            start = i;
    std::set<point_index> corners;
    for (std::size_t at = start;;) {
        corners.insert(static_cast<point_index>(at));
        std::size_t next = at == 0 ? 1 : 0;
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (p[i] == p[at]) continue;
            const long double side = turn(at, next, i);
            const bool is_farther = (p[i] - p[at]).norm() > (p[next] - p[at]).norm();
            if (p[next] == p[at] || side < 0 || (side == 0 && is_farther)) next = i;
        }
        at = next;
        if (p[at] == p[start]) return corners;
    }
}

/// Corners turn left and have the area that the polygon states; all points are within.
void expect_convex(const convex_polygon& polygon, const clouds::cloud& points, double rounding) {
    const std::size_t n = polygon.outline.size();
    ASSERT_EQ(polygon.vertices.size(), n);
    EXPECT_NEAR(polygon.axes.determinant(), 1.0, 1e-12);
    double twice_area = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector2d a = polygon.outline[i];
        const Eigen::Vector2d ab = polygon.outline[(i + 1) % n] - a;
        const Eigen::Vector2d ac = polygon.outline[(i + 2) % n] - a;
        if (n > 2) {
            EXPECT_GT(ab.x() * ac.y() - ab.y() * ac.x(), 0.0);
        }
        const Eigen::Vector2d b = a + ab - polygon.outline[0];
        twice_area += (a - polygon.outline[0]).x() * b.y() - (a - polygon.outline[0]).y() * b.x();
        for (const Eigen::Vector3d& p : points) {
            if (!gnomon::is_finite(p)) continue;
            const Eigen::Vector3d local = polygon.axes.transpose() * (p - polygon.origin);
            EXPECT_GE(ab.x() * (local.y() - a.y()) - ab.y() * (local.x() - a.x()),
                      -rounding * ab.norm());
        }
    }
    EXPECT_NEAR(polygon.area, 0.5 * twice_area, 1e-12 * std::abs(twice_area));
}

TEST(convex_polygon, has_the_corners_of_gift_wrapping) {
    for (std::uint64_t seed = 0; seed < 60; ++seed) {
        SCOPED_TRACE(seed);
        // In the plane z = 0, whose axes are permuted coordinates: projections are exact.
        clouds::cloud points =
            seed % 2 ? clouds::in_cube(80 + seed, seed) : clouds::on_grid(80 + seed, seed, 0.125);
        std::vector<Eigen::Vector2d> flat;
        const auto polygon = convex_polygon::of(points, gnomon::plane{});
        for (const Eigen::Vector3d& p : points) {
            const Eigen::Vector3d local = polygon.axes.transpose() * (p - points[0]);
            flat.emplace_back(local.x(), local.y());
        }
        EXPECT_EQ(std::set<point_index>(polygon.vertices.begin(), polygon.vertices.end()),
                  corners_by_gift_wrapping(flat));
        expect_convex(polygon, points, 1e-15);
    }
}

TEST(convex_polygon, of_a_wall_at_utm_coordinates_has_its_area) {
    const Eigen::Matrix3d turn = clouds::random_rotation(3);
    const Eigen::Vector3d corner(4e5, 5e6, 120.0);
    clouds::cloud points;
    gnomon::random_stream random(3);
    for (int i = 0; i < 5000; ++i) {
        points.push_back(corner + turn * Eigen::Vector3d(4.0 * random.uniform(),
                                                         2.5 * random.uniform(),
                                                         0.01 * random.gaussian()));
    }
    for (const double x : {0.0, 4.0})
        for (const double y : {0.0, 2.5})
            points.push_back(corner + turn * Eigen::Vector3d(x, y, 0));
    points.push_back({clouds::nan, 0, 0});
    const Eigen::Vector3d normal = turn.col(2);
    const auto polygon = convex_polygon::of(points, {normal, normal.dot(corner)});
    EXPECT_NEAR(polygon.area, 10.0, 1e-7);
    EXPECT_NEAR((polygon.axes.col(2) - normal).norm(), 0.0, 1e-15);
    expect_convex(polygon, points, 1e-8);
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
        const Eigen::Vector3d p = points[polygon.vertices[i]];
        EXPECT_NEAR(normal.dot(polygon.corner(i) - corner), 0.0, 1e-8);
        EXPECT_NEAR((p - polygon.corner(i)).cross(normal).norm(), 0.0, 1e-8);
    }
}

TEST(convex_polygon, is_invariant_to_permutation) {
    const clouds::cloud points = clouds::sheet(3000, 2);
    std::vector<std::size_t> order;
    const clouds::cloud shuffled = clouds::permuted(points, 1, order);
    const auto a = convex_polygon::of(points, gnomon::plane{});
    const auto b = convex_polygon::of(shuffled, gnomon::plane{});
    std::set<std::size_t> vertices;
    for (const point_index v : b.vertices) vertices.insert(order[v]);
    EXPECT_EQ(std::set<std::size_t>(a.vertices.begin(), a.vertices.end()), vertices);
    EXPECT_NEAR(a.area, b.area, 1e-14);
}

TEST(convex_polygon, of_degenerate_points_has_fewer_corners) {
    using list = std::vector<point_index>;
    const auto none = convex_polygon::of(clouds::cloud{{clouds::nan, 0, 0}}, gnomon::plane{});
    EXPECT_TRUE(none.outline.empty());
    const clouds::cloud column{{clouds::nan, 0, 0}, {4e5, 5e6, 1}, {4e5, 5e6, 7}};
    const auto one = convex_polygon::of(column, gnomon::plane{});
    EXPECT_EQ(one.vertices, list{1});
    clouds::cloud line;
    for (const int i : {3, 5, 0, 7, 7, 0, 2}) line.push_back({4e5 + 0.5 * i, 5e6 - i, 0.25 * i});
    const auto two = convex_polygon::of(line, gnomon::plane{});
    EXPECT_EQ(std::set<point_index>(two.vertices.begin(), two.vertices.end()),
              (std::set<point_index>{2, 3}));
    EXPECT_EQ(two.area, 0.0);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto polygon = convex_polygon::of(points, gnomon::plane{});
        EXPECT_FALSE(std::isnan(polygon.area));
        EXPECT_EQ(polygon.outline.size(), polygon.vertices.size());
    }
}

/// The corner at the right is extreme in the first direction and in the last one.
TEST(convex_polygon, leaves_out_inner_points_if_the_last_extreme_is_the_first) {
    std::vector<gnomon::detail::planar_point> points{{1, -0.9, 0},  {0.9, 1, 1}, {-1, 0.9, 2},
                                                     {-0.9, -1, 3}, {0, 0, 4},   {0.1, 0.2, 5}};
    gnomon::detail::remove_inner_points(points);
    EXPECT_EQ(points.size(), 4u);
}

TEST(convex_polygon, refuses_planes_that_are_none) {
    const clouds::cloud points = clouds::sheet(10, 1);
    EXPECT_THROW((void)convex_polygon::of(points, {{0, 0, 2}, 0.0}), std::invalid_argument);
    EXPECT_THROW((void)convex_polygon::of(points, {{0, 0, 1}, clouds::nan}), std::invalid_argument);
}

}  // namespace
