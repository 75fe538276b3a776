// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/plane.hpp>
#include <gnomon/features/alpha_shape.hpp>

namespace {

using gnomon::alpha_shape;
using gnomon::point_index;
using index_path = std::vector<point_index>;

constexpr double door_width = 0.9;
constexpr double door_height = 2.0;
constexpr double wall_area = 4.0 * 2.6 - door_width * door_height;

bool is_on_wall(double x, double y) {
    return x >= 0 && x <= 4.0 && y >= 0 && y <= 2.6 &&
           !(x > 1.5 && x < 1.5 + door_width && y > 0.3 && y < 0.3 + door_height);
}

clouds::cloud scattered_wall(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points;
    while (points.size() < n) {
        const double x = 4.0 * random.uniform();
        const double y = 2.6 * random.uniform();
        if (is_on_wall(x, y)) points.push_back({x, y, 0});
    }
    return points;
}

/// Lines of points dx and dy apart, with noise across and in the wall.
clouds::cloud lines_on_wall(double dx, double dy, double sigma, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    clouds::cloud points;
    for (int i = 0; i * dx <= 4.0 + 1e-9; ++i)
        for (int j = 0; j * dy <= 2.6 + 1e-9; ++j)
            if (is_on_wall(i * dx, j * dy))
                points.push_back(Eigen::Vector3d(i * dx, j * dy, 0) +
                                 sigma * clouds::gaussian_vector(random));
    return points;
}

/// Twice the signed area of the triangle of three points in the plane z = 0.
double twice_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
    return (b - a).cross(c - a).z();
}

double area_within(const clouds::cloud& p, const index_path& path) {
    double area = 0.0;
    for (std::size_t i = 2; i < path.size(); ++i)
        area += 0.5 * twice_area(p[path[0]], p[path[i - 1]], p[path[i]]);
    return area;
}

bool is_inside(const clouds::cloud& p, const index_path& path, const Eigen::Vector3d& x) {
    bool inside = false;
    for (std::size_t i = 0, j = path.size() - 1; i < path.size(); j = i++) {
        const Eigen::Vector3d a = p[path[i]], b = p[path[j]];
        if ((a.y() > x.y()) != (b.y() > x.y()) &&
            x.x() < (b.x() - a.x()) * (x.y() - a.y()) / (b.y() - a.y()) + a.x())
            inside = !inside;
    }
    return inside;
}

/// No path visits a point twice, and no two edges cross that are at the same x.
void expect_no_crossing(const clouds::cloud& p, const std::vector<index_path>& paths) {
    std::vector<std::array<point_index, 2>> edges;  // each from left to right
    for (const index_path& path : paths) {
        ASSERT_GE(path.size(), 3u);
        EXPECT_EQ(std::set<point_index>(path.begin(), path.end()).size(), path.size());
        EXPECT_EQ(path.front(), *std::min_element(path.begin(), path.end()));
        for (std::size_t i = 0; i < path.size(); ++i) {
            edges.push_back({path[i], path[(i + 1) % path.size()]});
            if (p[edges.back()[0]].x() > p[edges.back()[1]].x())
                std::swap(edges.back()[0], edges.back()[1]);
        }
    }
    std::sort(edges.begin(), edges.end(),
              [&](const auto& e, const auto& f) { return p[e[0]].x() < p[f[0]].x(); });
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto [a, b] = edges[i];
        for (std::size_t j = i + 1; j < edges.size(); ++j) {
            const auto [c, d] = edges[j];
            if (p[c].x() > p[b].x()) break;
            const bool crosses = twice_area(p[a], p[b], p[c]) * twice_area(p[a], p[b], p[d]) < 0 &&
                                 twice_area(p[c], p[d], p[a]) * twice_area(p[c], p[d], p[b]) < 0;
            ASSERT_FALSE(crosses) << a << " " << b << " and " << c << " " << d;
        }
    }
}

/// The laws of a shape of points in the plane z = 0.
void expect_shape(const clouds::cloud& p, const alpha_shape& shape) {
    std::vector<index_path> paths;
    double area = 0.0;
    double before = clouds::infinity;
    for (const auto& polygon : shape.polygons) {
        double own = area_within(p, polygon.outline);
        EXPECT_GT(own, 0.0);
        paths.push_back(polygon.outline);
        for (const index_path& hole : polygon.holes) {
            EXPECT_LT(area_within(p, hole), 0.0);
            own += area_within(p, hole);
            paths.push_back(hole);
            const std::set<point_index> outer(polygon.outline.begin(), polygon.outline.end());
            for (const point_index i : hole)
                EXPECT_TRUE(outer.contains(i) || is_inside(p, polygon.outline, p[i]));
        }
        EXPECT_NEAR(polygon.area, own, 1e-7 * own);
        EXPECT_LE(polygon.area, before);
        before = polygon.area;
        area += own;
    }
    EXPECT_NEAR(shape.area, area, 1e-7 * area);
    double of_triangles = 0.0;
    for (const auto& [a, b, c] : shape.triangles) {
        EXPECT_GT(twice_area(p[a], p[b], p[c]), 0.0);
        of_triangles += 0.5 * twice_area(p[a], p[b], p[c]);
    }
    EXPECT_NEAR(of_triangles, area, 1e-7 * area);
    expect_no_crossing(p, paths);
}

/// One polygon with one hole, the doorway, both to within half a spacing along all borders.
void expect_wall_with_door(const clouds::cloud& points, double spacing) {
    const alpha_shape wall = alpha_shape::of(points, gnomon::plane{});
    expect_shape(points, wall);
    ASSERT_EQ(wall.polygons.size(), 1u);
    ASSERT_EQ(wall.polygons[0].holes.size(), 1u);
    const double around_door = 2.0 * (door_width + door_height);
    const double door = -area_within(points, wall.polygons[0].holes[0]);
    EXPECT_NEAR(door, door_width * door_height, 0.5 * spacing * around_door);
    EXPECT_NEAR(wall.area, wall_area, 0.5 * spacing * (around_door + 2.0 * (4.0 + 2.6)));
}

TEST(alpha_shape, of_a_wall_has_its_door) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(seed);
        for (const std::size_t n : {1000u, 8000u, 30'000u}) {
            SCOPED_TRACE(n);
            const double spacing = std::sqrt(wall_area / static_cast<double>(n));
            expect_wall_with_door(scattered_wall(n, seed), spacing);
        }
        for (const double step : {0.1, 0.05, 0.02})
            for (const double noise : {0.0, 0.05, 0.3}) {
                SCOPED_TRACE(testing::Message() << step << " " << noise);
                expect_wall_with_door(lines_on_wall(step, step, noise * step, seed),
                                      (1.0 + 2.0 * noise) * step);
            }
    }
}

TEST(alpha_shape, connects_scan_lines) {
    // Five to thirty times denser along the lines, which are up to 15 mm of noise wide.
    for (const double along : {0.003, 0.01})
        for (const double across : {0.05, 0.1})
            for (const double sigma : {0.0, 0.001, 0.005, 0.015}) {
                SCOPED_TRACE(testing::Message() << along << " " << across << " " << sigma);
                const double spacing = across + 4.0 * sigma;
                expect_wall_with_door(lines_on_wall(along, across, sigma, 1), spacing);
                expect_wall_with_door(lines_on_wall(across, along, sigma, 2), spacing);
            }
}

TEST(alpha_shape, adapts_to_spacings_that_vary) {
    // As on a floor: lines farther and farther apart, 2 cm to 40 cm, with an opening where they are
    // dense.
    clouds::cloud points;
    gnomon::random_stream random(5);
    for (double x = 0.5; x < 10.0; x *= 1.04) {
        for (double y = -2.0; y <= 2.0; y += 0.01) {
            if (std::abs(x - 1.6) < 0.5 && std::abs(y) < 0.5) continue;
            points.push_back({x, y + 0.002 * random.gaussian(), 0});
        }
    }
    const alpha_shape floor = alpha_shape::of(points, gnomon::plane{});
    expect_shape(points, floor);
    ASSERT_EQ(floor.polygons.size(), 1u);
    ASSERT_EQ(floor.polygons[0].holes.size(), 1u);
    EXPECT_NEAR(-area_within(points, floor.polygons[0].holes[0]), 1.0, 0.12);
    EXPECT_NEAR(floor.area, 4.0 * (0.5 * std::pow(1.04, 76) - 0.5) - 1.0, 0.2);
}

TEST(alpha_shape, of_two_islands_has_two_polygons) {
    gnomon::random_stream random(2);
    clouds::cloud points;
    for (int i = 0; i < 4000; ++i) {
        points.push_back({random.uniform(), random.uniform(), 0});
        points.push_back({1.3 + 2.0 * random.uniform(), random.uniform(), 0});
        points.push_back({1.3 + 2.0 * random.uniform(), random.uniform(), 0});
    }
    points.push_back({10, 10, 0});  // an outlier
    const alpha_shape shape = alpha_shape::of(points, gnomon::plane{});
    expect_shape(points, shape);
    ASSERT_EQ(shape.polygons.size(), 2u);
    EXPECT_NEAR(shape.polygons[0].area, 2.0, 0.05);
    EXPECT_NEAR(shape.polygons[1].area, 1.0, 0.05);
    EXPECT_TRUE(shape.polygons[0].holes.empty() && shape.polygons[1].holes.empty());
}

TEST(alpha_shape, splits_paths_where_they_touch) {
    // A frame with an hourglass in it, whose waist is a single point: both holes have it.
    clouds::cloud points{{0, 0, 0}};
    for (int x = -20; x <= 20; ++x)
        for (int y = -14; y <= 14; ++y)
            if (std::abs(y) >= 10 || std::abs(x) >= 16) points.push_back({1.0 * x, 1.0 * y, 0});
    for (int row = 1; row < 10; ++row) {
        const int gaps = 1 + row * 2 / 5;
        for (int i = 0; i <= gaps; ++i)
            for (const int side : {-1, 1})
                points.push_back({0.2 * row * (2.0 * i / gaps - 1.0), 1.0 * side * row, 0});
    }
    const alpha_shape shape = alpha_shape::of(points, gnomon::plane{});
    expect_shape(points, shape);
    ASSERT_EQ(shape.polygons.size(), 1u);
    ASSERT_EQ(shape.polygons[0].holes.size(), 2u);
    for (const index_path& hole : shape.polygons[0].holes) {
        EXPECT_EQ(hole.front(), 0u);
        EXPECT_NEAR(area_within(points, hole), -(32.0 * 20.0 - 40.0) / 2.0, 15.0);
    }
}

TEST(alpha_shape, of_sparse_points_has_no_crossing) {
    for (std::uint64_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE(seed);
        clouds::cloud points =
            seed % 2 ? clouds::in_cube(10 + seed, seed) : clouds::on_grid(10 + seed, seed, 0.0625);
        for (Eigen::Vector3d& p : points) p.x() *= 1.0 + 30.0 * p.x() * p.x();
        expect_shape(points, alpha_shape::of(points, gnomon::plane{}));
    }
}

/// The shape with the indices that its points had before a permutation.
std::set<std::set<point_index>> paths_of(const alpha_shape& shape,
                                         const std::vector<std::size_t>& order) {
    std::set<std::set<point_index>> paths;
    const auto add = [&](const index_path& path) {
        std::set<point_index> own;
        for (const point_index i : path)
            own.insert(order.empty() ? i : static_cast<point_index>(order[i]));
        paths.insert(own);
    };
    for (const auto& polygon : shape.polygons) {
        add(polygon.outline);
        for (const index_path& hole : polygon.holes) add(hole);
    }
    return paths;
}

TEST(alpha_shape, is_invariant_to_order_and_motion) {
    const clouds::cloud points = scattered_wall(5000, 3);
    const alpha_shape shape = alpha_shape::of(points, gnomon::plane{});
    std::vector<std::size_t> order;
    const clouds::cloud shuffled = clouds::permuted(points, 1, order);
    const alpha_shape again = alpha_shape::of(shuffled, gnomon::plane{});
    EXPECT_EQ(paths_of(again, order), paths_of(shape, {}));
    EXPECT_EQ(again.area, shape.area);

    // A scan in UTM coordinates, with duplicates and points that are none.
    const Eigen::Matrix3d rotation = clouds::random_rotation(3);
    const Eigen::Vector3d shift(4e5, 5e6, 120.0);
    clouds::cloud moved = clouds::moved(points, rotation, shift);
    const clouds::cloud once = moved;
    moved.push_back({clouds::nan, 0, 0});
    moved.insert(moved.end(), once.begin(), once.end());
    const Eigen::Vector3d normal = rotation.col(2);
    const alpha_shape far = alpha_shape::of(moved, {normal, normal.dot(shift)});
    ASSERT_EQ(far.polygons.size(), 1u);
    ASSERT_EQ(far.polygons[0].holes.size(), 1u);
    EXPECT_EQ(paths_of(far, {}), paths_of(shape, {}));
    EXPECT_NEAR(far.area, shape.area, 1e-6);
    const alpha_shape behind = alpha_shape::of(moved, {-normal, -normal.dot(shift)});
    EXPECT_EQ(behind.polygons[0].outline.size(), far.polygons[0].outline.size());
    EXPECT_EQ(behind.polygons[0].outline[1], far.polygons[0].outline.back());
}

TEST(alpha_shape, of_degenerate_points_is_empty_or_a_shape) {
    const clouds::cloud none{{clouds::nan, 0, 0}};
    const clouds::cloud one{{1, 2, 3}};
    const clouds::cloud column{{1, 2, 3}, {1, 2, 4}, {1, 2, 5}};  // one place in the plane
    clouds::cloud line;
    for (const int i : {3, 5, 0, 7, 7, 2}) line.push_back({4e5 + 0.5 * i, 5e6 - i, 0.25 * i});
    for (const clouds::cloud& points : {clouds::cloud{}, none, one, column, line}) {
        const alpha_shape shape = alpha_shape::of(points, gnomon::plane{});
        EXPECT_TRUE(shape.polygons.empty() && shape.triangles.empty());
        EXPECT_EQ(shape.area, 0.0);
    }
    const clouds::cloud triangle{{0, 0, 0}, {1, 0, 5}, {0, 1, 0}};
    const alpha_shape smallest = alpha_shape::of(triangle, gnomon::plane{});
    ASSERT_EQ(smallest.polygons.size(), 1u);
    EXPECT_EQ(smallest.polygons[0].outline, (index_path{0, 1, 2}));
    EXPECT_NEAR(smallest.area, 0.5, 1e-9);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        EXPECT_FALSE(std::isnan(alpha_shape::of(points, gnomon::plane{}).area));
    }
}

TEST(alpha_shape, refuses_planes_that_are_none) {
    const clouds::cloud points = clouds::sheet(10, 1);
    EXPECT_THROW((void)alpha_shape::of(points, {{0, 0, 2}, 0.0}), std::invalid_argument);
    EXPECT_THROW((void)alpha_shape::of(points, {{0, 0, 1}, clouds::nan}), std::invalid_argument);
}

}  // namespace
