// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <deque>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include <gnomon/core/strided_view.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace {

using gnomon::knn, gnomon::plane_pca, gnomon::trust;

TEST(estimate_normals, measures_the_neighborhood) {
    const auto points = clouds::sheet(300, 1);
    const auto graph = knn{.k = 9}(points);
    const auto surface = gnomon::estimate_normals(points, graph, plane_pca{});
    for (std::size_t i = 0; i < points.size(); ++i) {
        double sum = 0.0;
        for (const auto j : graph[i]) sum += (points[i] - points[j]).norm();
        EXPECT_EQ(surface[i].neighbors, 9u);
        EXPECT_NEAR(surface[i].mean_distance, sum / 9, 1e-15);  // Eq. (4.2)
    }
}

/// The caller's own memory, through any door, gives the same bytes.
TEST(estimate_normals, reads_any_container) {
    struct laser_return {
        double time;
        Eigen::Vector3f xyz;
    };
    std::vector<Eigen::Vector3f> points;
    for (const auto& p : clouds::sheet(500, 2)) points.push_back(p.cast<float>());
    std::deque<laser_return> returns;
    Eigen::Matrix<float, 3, Eigen::Dynamic> matrix(3, 500);
    for (std::size_t i = 0; i < 500; ++i) {
        returns.push_back({0.0, points[i]});
        matrix.col(static_cast<Eigen::Index>(i)) = points[i];
    }
    const auto expected = gnomon::estimate_normals(points, knn{10}, plane_pca{});
    const auto from_deque = gnomon::estimate_normals(returns, knn{10}, plane_pca{},
                                                     gnomon::sequential{}, &laser_return::xyz);
    const auto from_matrix =
        gnomon::estimate_normals(gnomon::columns(matrix), knn{10}, plane_pca{}, gnomon::threads{2});
    for (std::size_t i = 0; i < 500; ++i) {
        EXPECT_EQ(from_deque[i].normal, expected[i].normal);
        EXPECT_EQ(from_matrix[i].normal, expected[i].normal);
    }
}

TEST(estimate_normals, takes_any_neighborhood) {
    const auto points = clouds::sheet(500, 3);
    const std::vector<std::vector<gnomon::point_index>> own(500);
    for (const auto& s : gnomon::estimate_normals(points, own, plane_pca{})) {
        EXPECT_EQ(s.trust, trust::too_few_neighbors);
    }
    const auto by_radius = gnomon::estimate_normals(points, gnomon::radius{.r = 0.2}, plane_pca{});
    const auto from_graph =
        gnomon::estimate_normals(points, gnomon::radius{.r = 0.2}(points), plane_pca{});
    for (std::size_t i = 0; i < 500; ++i) EXPECT_EQ(by_radius[i].normal, from_graph[i].normal);
}

/// Float points at UTM coordinates are half a metre apart: no normal can be good there.
TEST(estimate_normals, distrusts_coordinates_that_are_too_coarse) {
    std::vector<Eigen::Vector3f> near, far;
    for (const auto& p : clouds::sheet(500, 4)) {
        near.push_back(p.cast<float>());
        far.push_back((50.0 * p + Eigen::Vector3d(6e5, 4.8e6, 100)).cast<float>());
    }
    for (const auto& s : gnomon::estimate_normals(near, knn{20}, plane_pca{})) {
        EXPECT_EQ(s.trust, trust::good);
    }
    for (const auto& s : gnomon::estimate_normals(far, knn{20}, plane_pca{})) {
        EXPECT_NE(s.trust, trust::good);
    }
}

/// A NaN among the points changes no other normal.
TEST(estimate_normals, is_not_poisoned_by_nan) {
    auto points = clouds::sheet(400, 5);
    const auto clean = gnomon::estimate_normals(points, knn{12}, plane_pca{});
    for (int i = 0; i < 40; ++i) points.push_back({clouds::nan, 0.1 * i, clouds::infinity});
    const auto mixed = gnomon::estimate_normals(points, knn{12}, plane_pca{});
    for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(mixed[i].normal, clean[i].normal);
    for (std::size_t i = 400; i < 440; ++i) EXPECT_EQ(mixed[i].trust, trust::not_finite);
}

TEST(estimate_normals, hands_view_points_to_ray_estimators) {
    const auto points = clouds::sheet(50, 6);
    const auto looks_from = [](const Eigen::Vector3d& p, gnomon::ring_view,
                               const Eigen::Vector3d& v) -> Eigen::Vector3d { return v - p; };
    const Eigen::Vector3d v(1, 2, 30);
    for (const auto& s :
         gnomon::estimate_normals(gnomon::with_viewpoint(points, v), knn{5}, looks_from)) {
        EXPECT_GT(s.normal.z(), 0.9);
    }
    for (const auto& s : gnomon::estimate_normals(
             gnomon::with_viewpoint(points, {clouds::nan, 0, 0}), knn{5}, looks_from)) {
        EXPECT_EQ(s.trust, trust::not_finite);
    }
}

TEST(estimate_normals, refuses_a_graph_of_other_points) {
    const auto graph = knn{5}(clouds::sheet(10, 1));
    EXPECT_THROW((void)gnomon::estimate_normals(clouds::sheet(11, 1), graph, plane_pca{}),
                 std::invalid_argument);
}

}  // namespace
