// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

// CGAL asserts by default, and its own headers warn under -Wall.
#include "laws/clouds.hpp"
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/convex_hull.hpp>

namespace {

using gnomon::convex_hull;
using gnomon::hull_shape;
using gnomon::point_index;
using place = std::array<double, 3>;

place place_of(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

std::set<place> places_of(const clouds::cloud& points, const convex_hull& hull) {
    std::set<place> places;
    for (const point_index i : hull.vertices) places.insert(place_of(points[i]));
    EXPECT_EQ(places.size(), hull.vertices.size());
    return places;
}

/// Oracle: CGAL's polyhedron. Its corners that are flat are not extreme, and are removed by an
/// exact test: a corner is extreme if at least three of its edges are folds.
struct cgal_hull {
    std::set<place> extreme;
    double volume = 0.0;

    explicit cgal_hull(const clouds::cloud& points) {
        using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
        using mesh = CGAL::Surface_mesh<kernel::Point_3>;
        std::vector<kernel::Point_3> copies;
        for (const auto& p : points)
            if (gnomon::is_finite(p)) copies.emplace_back(p.x(), p.y(), p.z());
        mesh m;
        CGAL::convex_hull_3(copies.begin(), copies.end(), m);
        for (const auto v : m.vertices()) {
            int folds = 0;
            for (const auto h : CGAL::halfedges_around_target(m.halfedge(v), m)) {
                const auto& a = m.point(m.source(h));
                const auto& b = m.point(m.target(h));
                const auto& c = m.point(m.target(m.next(h)));
                const auto& d = m.point(m.target(m.next(m.opposite(h))));
                if (CGAL::orientation(a, b, c, d) != CGAL::COPLANAR) ++folds;
            }
            const auto& p = m.point(v);
            if (folds >= 3) extreme.insert({p.x(), p.y(), p.z()});
        }
        using exact = CGAL::Exact_predicates_exact_constructions_kernel::Point_3;
        const auto exactly = [&](const auto v) {
            const auto& p = m.point(v);
            return exact(p.x(), p.y(), p.z());
        };
        exact::R::FT sum = 0;
        const exact first = exactly(*m.vertices().begin());
        for (const auto f : m.faces()) {
            const auto h = m.halfedge(f);
            sum += CGAL::volume(first, exactly(m.source(h)), exactly(m.target(h)),
                                exactly(m.target(m.next(h))));
        }
        volume = CGAL::to_double(CGAL::exact(sum));
    }
};

/// The laws of a solid: a closed surface, convex, that contains all points; of equal points the
/// first is a corner.
void expect_laws(const clouds::cloud& points, const convex_hull& hull) {
    ASSERT_EQ(hull.shape, hull_shape::solid);
    EXPECT_TRUE(std::is_sorted(hull.vertices.begin(), hull.vertices.end()));
    EXPECT_EQ(hull.triangles.size(), 2 * hull.vertices.size() - 4);  // Euler
    std::set<std::pair<point_index, point_index>> edges;
    std::set<point_index> corners;
    for (const auto& t : hull.triangles) {
        for (std::size_t i = 0; i < 3; ++i) {
            corners.insert(t[i]);
            EXPECT_TRUE(edges.insert({t[i], t[(i + 1) % 3]}).second);
        }
    }
    for (const auto& [a, b] : edges) EXPECT_TRUE(edges.contains({b, a}));
    EXPECT_EQ(std::vector<point_index>(corners.begin(), corners.end()), hull.vertices);
    std::map<place, point_index> first;
    for (std::size_t i = 0; i < points.size(); ++i)
        first.insert({place_of(points[i]), static_cast<point_index>(i)});
    for (const point_index v : hull.vertices) EXPECT_EQ(first.at(place_of(points[v])), v);
    using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    const auto at = [&](std::size_t i) {
        return kernel::Point_3(points[i].x(), points[i].y(), points[i].z());
    };
    for (const auto& t : hull.triangles) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!gnomon::is_finite(points[i])) continue;
            ASSERT_NE(CGAL::orientation(at(t[0]), at(t[1]), at(t[2]), at(i)), CGAL::POSITIVE);
        }
    }
}

/// A random set, by kind: free, with ties, doubled, on spheres, in boxes, thin, at UTM coordinates,
/// in single precision, of mixed scales.
clouds::cloud random_set(std::uint64_t seed) {
    gnomon::random_stream random(seed, 3);
    const std::size_t n = 4 + random.below(120);
    clouds::cloud points = clouds::in_cube(n, seed);
    const int kind = static_cast<int>(seed % 10);
    const Eigen::Matrix3d turn = clouds::random_rotation(seed);
    for (Eigen::Vector3d& p : points) {
        if (kind == 1) p = (3.0 * p).array().floor();
        if (kind == 2 && random.uniform() < 0.5) p = points[0];
        if (kind == 3) p = (p - Eigen::Vector3d::Constant(0.5)).normalized();
        if (kind == 4) p = turn * (2.0 * p).array().floor().matrix();
        if (kind == 5) p = turn * Eigen::Vector3d(p.x(), p.y(), 1e-9 * p.z());
        if (kind == 6) p += Eigen::Vector3d(4e5, 5e6, 100.0);
        if (kind == 7) p = (turn * (4.0 * p).array().round().matrix()).cast<float>().cast<double>();
        if (kind == 8) p *= std::pow(10.0, -9.0 * random.uniform());
        if (kind == 9)
            p = Eigen::Vector3d(4e5, 5e6, 0.0) + turn * (3.0 * p).array().floor().matrix();
    }
    return points;
}

TEST(convex_hull, equals_that_of_cgal_on_random_and_degenerate_sets) {
    int solids = 0;
    for (std::uint64_t seed = 0; seed < 1100; ++seed) {
        SCOPED_TRACE(seed);
        const clouds::cloud points = random_set(seed);
        const convex_hull hull = convex_hull::of(points);
        if (hull.shape != hull_shape::solid) continue;
        ++solids;
        const cgal_hull oracle(points);
        EXPECT_EQ(places_of(points, hull), oracle.extreme);
        EXPECT_NEAR(hull.volume / oracle.volume, 1.0, 1e-10);
        if (seed % 5 == 0 || seed % 10 == 1 || seed % 10 == 7) expect_laws(points, hull);
    }
    EXPECT_GE(solids, 1000);
}

TEST(convex_hull, of_many_points_equals_that_of_cgal) {
    for (const double thickness : {1.0, 0.01}) {
        clouds::cloud points = clouds::in_cube(70000, 5);
        const Eigen::Matrix3d turn = clouds::random_rotation(5);
        for (Eigen::Vector3d& p : points) {
            p = Eigen::Vector3d(4e5, 5e6, 1e2) +
                turn * Eigen::Vector3d(p.x(), p.y(), thickness * p.z());
        }
        points.insert(points.end(), points.begin(), points.begin() + 40000);
        const convex_hull hull = convex_hull::of(points);
        const cgal_hull oracle(points);
        EXPECT_EQ(places_of(points, hull), oracle.extreme);
        EXPECT_NEAR(hull.volume / oracle.volume, 1.0, 1e-10);
        EXPECT_LT(hull.vertices.back(), 70000u);
    }
}

/// A pair of points is an edge of the hull of coplanar points if all others are on one side; brute
/// force over pairs, exact for integers.
std::set<place> corners_by_brute_force(const std::vector<std::array<int, 2>>& points,
                                       const std::function<place(int, int)>& lift) {
    std::set<place> corners;
    for (const auto& a : points) {
        bool is_extreme = true;  // unless it lies in a triangle or on a line of others
        for (const auto& b : points) {
            for (const auto& c : points) {
                const int bx = b[0] - a[0], by = b[1] - a[1], cx = c[0] - a[0], cy = c[1] - a[1];
                if ((bx == 0 && by == 0) || (cx == 0 && cy == 0)) continue;
                if (bx * cy - by * cx == 0 && bx * cx + by * cy < 0) is_extreme = false;
                if (bx * cy - by * cx <= 0) continue;
                for (const auto& d : points) {
                    const int dx = d[0] - a[0], dy = d[1] - a[1];
                    if (cx * dy - cy * dx > 0 && dx * by - dy * bx > 0) is_extreme = false;
                }
            }
        }
        if (is_extreme) corners.insert(lift(a[0], a[1]));
    }
    return corners;
}

TEST(convex_hull, of_coplanar_points_is_that_in_their_plane) {
    for (std::uint64_t seed = 0; seed < 120; ++seed) {
        SCOPED_TRACE(seed);
        gnomon::random_stream random(seed, 8);
        const auto small = [&] { return static_cast<int>(random.below(7)) - 3; };
        const int u[3]{small(), small(), small()}, v[3]{small(), small(), small()};
        const Eigen::Vector3d normal =
            Eigen::Vector3d(u[0], u[1], u[2]).cross(Eigen::Vector3d(v[0], v[1], v[2]));
        if (normal.norm() == 0.0) continue;
        const auto lift = [&](int a, int b) {
            return place{4e5 + 0.25 * (a * u[0] + b * v[0]), 5e6 + 0.25 * (a * u[1] + b * v[1]),
                         0.25 * (a * u[2] + b * v[2])};
        };
        std::vector<std::array<int, 2>> plane{{0, 0}, {1, 0}, {0, 1}};
        clouds::cloud points;
        for (int i = 0; i < 12; ++i) plane.push_back({small(), small()});
        for (const auto& p : plane) {
            const place q = lift(p[0], p[1]);
            points.push_back({q[0], q[1], q[2]});
        }
        const convex_hull hull = convex_hull::of(points);
        ASSERT_EQ(hull.shape, hull_shape::planar);
        EXPECT_EQ(places_of(points, hull), corners_by_brute_force(plane, lift));
        EXPECT_TRUE(hull.triangles.empty());
        EXPECT_EQ(hull.volume, 0.0);
        Eigen::Vector3d twice_area = Eigen::Vector3d::Zero();  // in the order around it
        for (std::size_t i = 1; i + 1 < hull.vertices.size(); ++i) {
            const Eigen::Vector3d& a = points[hull.vertices[0]];
            twice_area += (points[hull.vertices[i]] - a).cross(points[hull.vertices[i + 1]] - a);
        }
        EXPECT_NEAR(hull.area / (0.5 * twice_area.norm()), 1.0, 1e-12);
    }
}

TEST(convex_hull, names_degenerate_sets) {
    using cloud = clouds::cloud;
    using list = std::vector<point_index>;
    const auto nothing = convex_hull::of(cloud{{clouds::nan, 0, 0}, {0, clouds::infinity, 0}});
    EXPECT_EQ(nothing.shape, hull_shape::none);
    EXPECT_TRUE(nothing.vertices.empty());
    const auto one = convex_hull::of(cloud{{clouds::nan, 0, 0}, {4e5, -0.0, 1}, {4e5, 0.0, 1}});
    EXPECT_EQ(one.shape, hull_shape::point);
    EXPECT_EQ(one.vertices, list{1});
    cloud line;
    for (const int i : {3, 5, 0, 7, 7, 0, 2}) line.push_back({4e5 + 0.5 * i, 5e6 - i, 0.25 * i});
    const auto collinear = convex_hull::of(line);
    EXPECT_EQ(collinear.shape, hull_shape::line);
    EXPECT_EQ(collinear.vertices, (list{2, 3}));
    EXPECT_EQ(collinear.area, 0.0);
}

TEST(convex_hull, of_a_cube_has_its_size) {
    for (const double size : {1e-100, 1e-3, 1.0, 1e40}) {
        clouds::cloud points = clouds::on_grid(3000, 4, 1.0);  // 0, 1
        for (Eigen::Vector3d& p : points) p *= size;
        points.push_back({clouds::nan, 0, 0});
        const auto hull = convex_hull::of(points);
        EXPECT_EQ(hull.vertices.size(), 8u);
        EXPECT_NEAR(hull.volume / (size * size * size), 1.0, 1e-14);
        EXPECT_NEAR(hull.area / (6.0 * size * size), 1.0, 1e-14);
    }
}

TEST(convex_hull, is_invariant_to_permutation_motion_and_repetition) {
    for (std::uint64_t seed = 0; seed < 40; ++seed) {
        const clouds::cloud points = random_set(seed);
        const auto hull = convex_hull::of(points);
        std::vector<std::size_t> order;
        const clouds::cloud shuffled = clouds::permuted(points, seed, order);
        const auto same = convex_hull::of(shuffled);
        EXPECT_EQ(places_of(shuffled, same), places_of(points, hull));
        EXPECT_NEAR(same.volume, hull.volume, 1e-12 * hull.volume);
        EXPECT_NEAR(same.area, hull.area, 1e-12 * hull.area);
        const auto twice = convex_hull::of(gnomon::subset_view(points, hull.vertices));
        EXPECT_EQ(twice.vertices.size(), hull.vertices.size());
        EXPECT_NEAR(twice.volume, hull.volume, 1e-12 * hull.volume);
        if (seed % 10 != 0 && seed % 10 != 3) continue;  // elsewhere rounding bends facets
        const auto moved = convex_hull::of(
            clouds::moved(points, clouds::random_rotation(seed + 1), {4e5, 5e6, 100.0}));
        EXPECT_EQ(moved.vertices, hull.vertices);
        EXPECT_NEAR(moved.volume, hull.volume, 1e-7 * hull.volume);
    }
}

TEST(convex_hull, survives_every_cloud) {
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto hull = convex_hull::of(points);
        EXPECT_FALSE(std::isnan(hull.volume) || std::isnan(hull.area));
        for (const point_index v : hull.vertices) EXPECT_TRUE(gnomon::is_finite(points[v]));
    }
    clouds::cloud scales = clouds::in_cube(300, 1);
    for (std::size_t i = 0; i < scales.size(); ++i)
        scales[i] *= std::pow(10.0, -static_cast<double>(i));
    EXPECT_EQ(convex_hull::of(scales).shape, hull_shape::solid);
}

TEST(convex_hull, takes_any_points) {
    struct record {
        int id;
        std::array<float, 3> xyz;
    };
    std::vector<record> records;
    for (int i = 0; i < 9; ++i)
        records.push_back({i,
                           {static_cast<float>(i % 2), static_cast<float>(i / 2 % 2),
                            static_cast<float>(i / 4 % 2)}});
    const auto hull = convex_hull::of(records, &record::xyz);
    EXPECT_EQ(hull.vertices.size(), 8u);
    EXPECT_DOUBLE_EQ(hull.volume, 1.0);
}

}  // namespace
