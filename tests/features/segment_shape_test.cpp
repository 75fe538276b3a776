// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/segment_shape.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::point_index, gnomon::segment_shape;
using extent = segment_shape::extent;

struct bare_element {
    Eigen::Vector3d normal;
};

std::vector<point_index> all_of(std::size_t n) {
    std::vector<point_index> all(n);
    std::iota(all.begin(), all.end(), point_index{0});
    return all;
}

segment_shape shape_without_normals(const auto& points) {
    const std::vector<bare_element> none(points.size(), {{0.0, 0.0, 0.0}});
    return segment_shape::of(points, none, all_of(points.size()));
}

/// Points of a cylinder of radius 0.3 m and 0.8 m height about the z-axis, all around.
clouds::cloud upright_cylinder(std::size_t n) {
    gnomon::random_stream random(4);
    clouds::cloud points;
    for (std::size_t i = 0; i < n; ++i) {
        const double t = 6.283185307179586 * random.uniform();
        points.emplace_back(0.3 * std::cos(t), 0.3 * std::sin(t), 0.8 * random.uniform());
    }
    return points;
}

/// Klasing 2010, Sec. 3.5.1: the variation of a cylinder and that of its points.
TEST(segment_shape, differs_from_its_points_on_a_cylinder) {
    const auto points = upright_cylinder(10000);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 30}, gnomon::plane_pca{});
    const auto shape = segment_shape::of(points, surface, all_of(points.size()));
    EXPECT_LT(shape.mean_surface_variation, 0.05);
    EXPECT_GT(shape.surface_variation(), 0.3);
    EXPECT_EQ(shape.spread, extent::volume);
}

/// Oracles: sums by Eigen over the points of one half of a noisy sheet.
TEST(segment_shape, has_the_means_and_the_frame_of_its_points) {
    const Eigen::Vector3d eye(0.3, 0.2, 2.0);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const auto points = clouds::sheet(400, seed);
        auto surface = gnomon::estimate_normals(points, gnomon::knn{.k = 12}, gnomon::plane_pca{});
        surface[7].normal = {0.0, 0.0, 0.0};
        surface[9].normal = {clouds::nan, 0.0, 0.0};
        std::vector<point_index> half;
        for (point_index i = 1; i < points.size(); i += 2) half.push_back(i);
        const auto seen = gnomon::with_viewpoint(points, eye);
        const auto shape = segment_shape::of(seen, surface, half);

        Eigen::Vector3d mean(0, 0, 0), normals(0, 0, 0);
        double variation = 0.0;
        clouds::cloud chosen;
        for (const point_index i : half) {
            chosen.push_back(points[i]);
            mean += points[i] / 200.0;
            if (i == 7 || i == 9) continue;
            const Eigen::Vector3d n = surface[i].normal;
            normals += n.dot(eye - points[i]) < 0.0 ? Eigen::Vector3d(-n) : n;
            variation += surface[i].surface_variation() / 198.0;
        }
        EXPECT_EQ(shape.points, 200u);
        EXPECT_EQ(shape.spread, extent::volume);
        EXPECT_LE((shape.frame.centroid - mean).norm(), 1e-12);
        EXPECT_LE((shape.mean_normal - normals.normalized()).norm(), 1e-12);
        EXPECT_NEAR(shape.mean_surface_variation, variation, 1e-12);
        EXPECT_GT(shape.normal.z(), 0.9) << "towards the view point";
        const auto frame = gnomon::principal_frame::of(chosen);
        EXPECT_EQ(shape.frame.box_size, frame.box_size);
        EXPECT_EQ(shape.normal.cwiseAbs(), frame.normal().cwiseAbs());
        EXPECT_EQ(shape.surface_variation(), frame.spectrum.surface_variation());
        EXPECT_EQ(shape.aspect_ratio(), frame.spectrum.aspect_ratio());
    }
}

TEST(segment_shape, faces_its_view_points_or_its_mean_normal) {
    const auto points = clouds::sheet(100, 3);
    for (const double side : {-1.0, 1.0}) {
        const std::vector<bare_element> surface(points.size(), {{0.0, 0.0, side}});
        const auto members = all_of(points.size());
        EXPECT_GT(side * segment_shape::of(points, surface, members).normal.z(), 0.9);
        EXPECT_EQ(segment_shape::of(points, surface, members).mean_normal.z(), side);
        for (const double eye : {-2.0, 2.0}) {
            const auto seen = gnomon::with_viewpoint(points, {0.5, 0.5, eye});
            EXPECT_GT(eye * segment_shape::of(seen, surface, members).normal.z(), 1.8);
            EXPECT_EQ(segment_shape::of(seen, surface, members).mean_normal.z(), eye / 2.0);
        }
    }
}

/// Law: a rigid motion of points, normals and view point moves the shape and changes nothing else.
/// A permutation changes nothing.
TEST(segment_shape, moves_with_its_points_and_ignores_their_order) {
    const auto points = clouds::sheet(300, 5);
    const Eigen::Vector3d eye(0.3, 0.2, 2.0);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 12}, gnomon::plane_pca{});
    const auto here = segment_shape::of(gnomon::with_viewpoint(points, eye), surface, all_of(300));
    const Eigen::Matrix3d r = clouds::random_rotation(6);
    for (const Eigen::Vector3d& t : {Eigen::Vector3d(1, 2, 3), {4e5, 5e6, 100.0}}) {
        const auto moved = clouds::moved(points, r, t);
        auto turned = surface;
        for (auto& e : turned) e.normal = r * e.normal;
        const auto there = segment_shape::of(
            gnomon::with_viewpoint(moved, Eigen::Vector3d(r * eye + t)), turned, all_of(300));
        EXPECT_EQ(there.spread, here.spread);
        EXPECT_LE((there.frame.centroid - r * here.frame.centroid - t).norm(), 1e-8);
        EXPECT_LE((there.normal - r * here.normal).norm(), 1e-7);
        EXPECT_LE((there.mean_normal - r * here.mean_normal).norm(), 1e-8);
        EXPECT_LE((there.frame.box_size - here.frame.box_size).norm(), 1e-7);
        EXPECT_NEAR(there.surface_variation(), here.surface_variation(), 1e-7);
        EXPECT_NEAR(there.mean_surface_variation, here.mean_surface_variation, 1e-12);
    }
    std::vector<std::size_t> order;
    const auto shuffled = clouds::permuted(points, 8, order);
    auto reordered = surface;
    for (std::size_t i = 0; i < order.size(); ++i) reordered[i] = surface[order[i]];
    const auto same =
        segment_shape::of(gnomon::with_viewpoint(shuffled, eye), reordered, all_of(300));
    EXPECT_LE((same.normal - here.normal).norm(), 1e-12);
    EXPECT_LE((same.mean_normal - here.mean_normal).norm(), 1e-12);
    EXPECT_LE((same.frame.centroid - here.frame.centroid).norm(), 1e-14);
}

TEST(segment_shape, names_what_is_degenerate) {
    EXPECT_EQ(shape_without_normals(clouds::cloud{}).spread, extent::none);
    EXPECT_EQ(shape_without_normals(clouds::cloud(3, {clouds::nan, 0, 0})).spread, extent::none);
    for (const Eigen::Vector3d& far : {Eigen::Vector3d(0, 0, 0), {4e5, 5e6, 100.0}}) {
        const Eigen::Matrix3d turn = clouds::random_rotation(3);
        clouds::cloud line, plane, ball;
        gnomon::random_stream random(9);
        for (int i = 0; i < 50; ++i) {
            const Eigen::Vector3d x = clouds::gaussian_vector(random);
            line.push_back(far + x[0] * turn.col(0));
            plane.push_back(far + x[0] * turn.col(0) + 0.01 * x[1] * turn.col(1));
            ball.push_back(far + x);
        }
        const auto at_one_place = shape_without_normals(clouds::cloud(5, far));
        EXPECT_EQ(at_one_place.spread, extent::point);
        EXPECT_EQ(at_one_place.points, 5u);
        EXPECT_EQ(shape_without_normals(clouds::cloud(1, far)).spread, extent::point);
        EXPECT_EQ(shape_without_normals(line).spread, extent::line);
        EXPECT_TRUE(shape_without_normals(line).normal.isZero());
        EXPECT_EQ(shape_without_normals(plane).spread, extent::plane);
        EXPECT_TRUE(shape_without_normals(plane).is_surface());
        EXPECT_EQ(shape_without_normals(ball).spread, extent::volume);
    }
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto shape = shape_without_normals(points);
        EXPECT_EQ(shape.points == 0, shape.spread == extent::none);
        EXPECT_FALSE(shape.frame.centroid.hasNaN());
        EXPECT_NEAR(shape.normal.norm(), shape.is_surface() ? 1.0 : 0.0, 1e-12);
        EXPECT_TRUE(shape.mean_normal.isZero());
        EXPECT_EQ(shape.mean_surface_variation, 0.0);
    }
}

TEST(segment_shape, is_one_for_each_segment) {
    const auto points = clouds::sheet(300, 5);
    const auto surface =
        gnomon::estimate_normals(points, gnomon::knn{.k = 12}, gnomon::plane_pca{});
    std::vector<std::vector<point_index>> parts(7);
    for (point_index i = 0; i < 300; ++i) parts[i % 6].push_back(i);
    const auto shapes = gnomon::segment_shapes(points, surface, parts);
    ASSERT_EQ(shapes.size(), 7u);
    EXPECT_EQ(shapes[6].spread, extent::none);
    const auto again = gnomon::segment_shapes(points, surface, parts, gnomon::threads{3});
    for (std::size_t s = 0; s < 7; ++s) {
        EXPECT_EQ(shapes[s].normal, segment_shape::of(points, surface, parts[s]).normal);
        EXPECT_EQ(again[s].normal, shapes[s].normal);
        EXPECT_EQ(again[s].mean_surface_variation, shapes[s].mean_surface_variation);
    }
}

TEST(segment_shape, refuses_numbers_that_do_not_fit) {
    const auto points = clouds::in_cube(10, 1);
    const std::vector<bare_element> surface(9, {{0, 0, 1}}), right(10, {{0, 0, 1}});
    EXPECT_THROW((void)segment_shape::of(points, surface, all_of(9)), std::invalid_argument);
    EXPECT_THROW((void)segment_shape::of(points, right, all_of(11)), std::invalid_argument);
}

}  // namespace
