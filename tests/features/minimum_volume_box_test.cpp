// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/optimal_bounding_box.h>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/features/convex_hull.hpp>
#include <gnomon/features/detail/flush_boxes.hpp>
#include <gnomon/features/detail/local_points.hpp>
#include <gnomon/features/detail/polytope.hpp>
#include <gnomon/features/minimum_volume_box.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace {

using gnomon::minimum_volume_box;
using gnomon::oriented_box;

/// Oracle: a genetic algorithm, which gives nearly the smallest box.
double volume_by_cgal(const clouds::cloud& points) {
    using kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
    std::vector<kernel::Point_3> copies;
    for (const auto& p : points) copies.emplace_back(p.x(), p.y(), p.z());
    std::array<kernel::Point_3, 8> corners;
    CGAL::oriented_bounding_box(copies, corners, CGAL::parameters::use_convex_hull(true));
    double volume = 1.0;  // corners 1, 3 and 5 are adjacent to corner 0
    for (const std::size_t i : {1u, 3u, 5u})
        volume *= std::sqrt(CGAL::squared_distance(corners[0], corners[i]));
    return volume;
}

void expect_box_around(const oriented_box& box, const clouds::cloud& points, double rounding) {
    EXPECT_NEAR((box.axes.transpose() * box.axes - Eigen::Matrix3d::Identity()).norm(), 0, 1e-12);
    EXPECT_NEAR(box.axes.determinant(), 1.0, 1e-12);
    EXPECT_GE(box.lengths[0], box.lengths[1]);
    EXPECT_GE(box.lengths[1], box.lengths[2]);
    for (const Eigen::Vector3d& p : points) {
        if (!gnomon::is_finite(p)) continue;
        const Eigen::Vector3d x = box.axes.transpose() * (p - box.center);
        for (int a = 0; a < 3; ++a) EXPECT_LE(std::abs(x[a]), 0.5 * box.lengths[a] + rounding);
    }
}

/// Points, by kind: free, on a sphere, in a cube, on an ellipsoid, on a cylinder, corners of boxes,
/// a noisy wall, on a grid.
clouds::cloud random_body(int kind, std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed, static_cast<std::uint64_t>(kind));
    const Eigen::Matrix3d turn = clouds::random_rotation(seed + 100);
    clouds::cloud points;
    for (std::size_t i = 0; i < n; ++i) {
        const Eigen::Vector3d g = clouds::gaussian_vector(random);
        const Eigen::Vector3d u(random.uniform(), random.uniform(), random.uniform());
        const double t = 6.3 * u.x();
        Eigen::Vector3d p = g;
        if (kind == 1) p = g.normalized();
        if (kind == 2) p = u;
        if (kind == 3) p = g.normalized().cwiseProduct(Eigen::Vector3d(3, 2, 1));
        if (kind == 4) p = {std::cos(t), std::sin(t), 2.0 * u.z()};
        if (kind == 5) p = u.array().round().matrix().cwiseProduct(Eigen::Vector3d(3, 2, 1));
        if (kind == 6) p = {5.0 * u.x(), 3.0 * u.y(), 0.005 * g.z()};
        if (kind == 7) p = (3.0 * u).array().floor();
        points.push_back(turn * p);
    }
    return points;
}

TEST(minimum_volume_box, of_a_turned_cube_is_the_cube) {
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Eigen::Matrix3d turn = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& center :
             {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4e5, 5e6, 100)}) {
            clouds::cloud points = clouds::moved(clouds::on_grid(200, seed, 1.0), turn, center);
            points.push_back({clouds::nan, 0, 0});
            const oriented_box box = minimum_volume_box(points);
            EXPECT_NEAR(box.volume(), 1.0, 1e-6);
            EXPECT_NEAR((box.center - center - turn * Eigen::Vector3d(0.5, 0.5, 0.5)).norm(), 0,
                        1e-6);
            expect_box_around(box, points, 1e-8);
        }
    }
}

TEST(minimum_volume_box, is_not_larger_than_that_of_cgal) {
    for (int kind = 0; kind < 8; ++kind) {
        for (std::uint64_t seed = 0; seed < 12; ++seed) {
            SCOPED_TRACE(kind);
            SCOPED_TRACE(seed);
            const clouds::cloud points = random_body(kind, 10 + 15 * seed, seed);
            const oriented_box box = minimum_volume_box(points);
            expect_box_around(box, points, 1e-13);
            EXPECT_LE(box.volume(), (1.0 + 1e-6) * volume_by_cgal(points));
            EXPECT_LE(box.volume(),
                      (1.0 + 1e-12) * gnomon::principal_frame::of(points).box().volume());
        }
    }
}

TEST(minimum_volume_box, of_larger_hulls_is_nearly_the_smallest) {
    for (const int kind : {1, 3, 4, 6}) {
        for (std::uint64_t seed = 0; seed < 2; ++seed) {
            SCOPED_TRACE(kind);
            const clouds::cloud points = random_body(kind, 700, seed);
            const oriented_box box = minimum_volume_box(points);
            expect_box_around(box, points, 1e-13);
            EXPECT_LE(box.volume(), 1.001 * volume_by_cgal(points));
            EXPECT_LE(box.volume(),
                      (1.0 + 1e-12) * gnomon::principal_frame::of(points).box().volume());
        }
    }
}

/// The search on the corners of the hull of some points.
gnomon::detail::smallest_box searched(const clouds::cloud& points) {
    const auto hull = gnomon::convex_hull::of(points);
    const gnomon::detail::local_points local(
        gnomon::subset_view<clouds::cloud>(points, hull.vertices));
    return {local.positions,
            {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY(), Eigen::Vector3d::UnitZ()}};
}

TEST(minimum_volume_box, of_hulls_of_up_to_200_vertices_is_proven) {
    for (int kind = 0; kind < 8; ++kind) {
        for (std::uint64_t seed = 0; seed < 6; ++seed) {
            SCOPED_TRACE(kind);
            const clouds::cloud points = random_body(kind, 10 + 30 * seed, seed + 50);
            EXPECT_TRUE(searched(points).is_proven());
        }
    }
    for (const int sides : {3, 4, 7, 8, 30}) {  // many boxes have the same volume
        SCOPED_TRACE(sides);
        clouds::cloud prism;
        for (int i = 0; i < sides; ++i) {
            const double t = 2.0 * 3.141592653589793 * i / sides;
            prism.push_back({std::cos(t), std::sin(t), 0.0});
            prism.push_back({std::cos(t), std::sin(t), 1.0});
        }
        EXPECT_TRUE(
            searched(clouds::moved(prism, clouds::random_rotation(5), {0, 0, 0})).is_proven());
    }
    EXPECT_FALSE(searched(random_body(1, 2000, 1)).is_proven());  // no proof by 200 of them
}

TEST(minimum_volume_box, is_not_proven_by_a_search_that_is_cut_off) {
    using gnomon::detail::flush_boxes, gnomon::detail::polytope;
    const clouds::cloud corners{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    EXPECT_TRUE(flush_boxes(polytope(corners), 7.9).is_complete());
    EXPECT_FALSE(flush_boxes(polytope(corners), clouds::nan).is_complete());  // nothing is excluded
    const clouds::cloud square{{1, 1, 0}, {-1, -1, 0}, {-1, 1, 0}, {1, -1, 0}};
    EXPECT_FALSE(flush_boxes(polytope(square), 7.9).is_complete());
}

/// O'Rourke's family: the smallest box of a regular tetrahedron has no face on a facet of it.
TEST(minimum_volume_box, of_a_tetrahedron_is_the_cube_around_it) {
    const Eigen::Matrix3d turn = clouds::random_rotation(1);
    const clouds::cloud corners{{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}};
    EXPECT_NEAR(minimum_volume_box(clouds::moved(corners, turn, {0, 0, 0})).volume(), 8.0, 1e-7);
}

TEST(minimum_volume_box, is_invariant_to_permutation_motion_and_scale) {
    for (int kind = 0; kind < 8; ++kind) {
        const clouds::cloud points = random_body(kind, 120, 3);
        const double volume = minimum_volume_box(points).volume();
        std::vector<std::size_t> order;
        EXPECT_NEAR(minimum_volume_box(clouds::permuted(points, 4, order)).volume() / volume, 1.0,
                    1e-6);
        clouds::cloud moved = clouds::moved(points, clouds::random_rotation(9), {1, 2, 3});
        EXPECT_NEAR(minimum_volume_box(moved).volume() / volume, 1.0, 1e-6);
        for (Eigen::Vector3d& p : moved) p *= 1e-30;
        EXPECT_NEAR(minimum_volume_box(moved).volume() / volume / 1e-90, 1.0, 1e-6);
        moved = clouds::moved(points, Eigen::Matrix3d::Identity(), {4e5, 5e6, 100});
        EXPECT_NEAR(minimum_volume_box(moved).volume() / volume, 1.0, 1e-5);
    }
}

TEST(minimum_volume_box, of_degenerate_points_has_fewer_lengths) {
    const oriented_box none = minimum_volume_box(clouds::cloud{{clouds::nan, 0, 0}});
    EXPECT_EQ(none.lengths, Eigen::Vector3d::Zero());
    const oriented_box one = minimum_volume_box(clouds::cloud(3, {4e5, 5e6, 1}));
    EXPECT_EQ(one.lengths, Eigen::Vector3d::Zero());
    EXPECT_NEAR((one.center - Eigen::Vector3d(4e5, 5e6, 1)).norm(), 0.0, 2e-9);
    const oriented_box line = minimum_volume_box(clouds::cloud{{1, 1, 1}, {4, 5, 1}, {2.5, 3, 1}});
    EXPECT_NEAR((line.lengths - Eigen::Vector3d(5, 0, 0)).norm(), 0.0, 1e-12);
    const clouds::cloud square{{0, 0, 0}, {2, 2, 0}, {-2, 2, 0}, {0, 4, 0}, {0, 2, 0}};
    const oriented_box plane = minimum_volume_box(square);
    EXPECT_NEAR((plane.lengths - Eigen::Vector3d(8, 8, 0).cwiseSqrt()).norm(), 0.0, 1e-12);
    expect_box_around(plane, square, 1e-12);
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const oriented_box box = minimum_volume_box(points);
        EXPECT_TRUE(box.center.allFinite() && box.axes.allFinite() && box.lengths.allFinite());
        EXPECT_NEAR(box.axes.determinant(), 1.0, 1e-9);
    }
}

/// Where rounding alone lifts points off their plane, its height does not decide on the rectangle.
TEST(minimum_volume_box, of_a_turned_rectangle_is_the_rectangle) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        clouds::cloud points = clouds::in_cube(400, seed);
        for (Eigen::Vector3d& p : points) p = {2.0 * p.x(), p.y(), 0.0};
        for (const double x : {0.0, 2.0})
            for (const double y : {0.0, 1.0}) points.push_back({x, y, 0.0});
        points = clouds::moved(points, clouds::random_rotation(seed), {0, 0, 0});
        const oriented_box box = minimum_volume_box(points);
        EXPECT_NEAR((box.lengths - Eigen::Vector3d(2, 1, 0)).norm(), 0.0, 1e-12);
    }
}

TEST(minimum_volume_box, takes_any_points) {
    struct record {
        std::array<float, 3> xyz;
    };
    std::vector<record> records;
    for (int i = 0; i < 8; ++i)
        records.push_back({{static_cast<float>(i % 2), static_cast<float>(i / 2 % 2),
                            2.0F * static_cast<float>(i / 4)}});
    EXPECT_NEAR(minimum_volume_box(records, &record::xyz).volume(), 2.0, 1e-7);
}

}  // namespace
