// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <deque>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/estimator_laws.hpp"
#include "laws/images.hpp"
#include "normals/dense_oracles.hpp"
#include "oracles/nanoflann_index.hpp"
#include <gnomon/core/strided_view.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/raster.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
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

/// Vectors, spans, projections and the caller's own point type give the same bytes.
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
    for (std::size_t i = 0; i < 500; ++i)
        EXPECT_LE(laws::angle_between(by_radius[i].normal, from_graph[i].normal), 1e-12);
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
TEST(estimate_normals, does_not_propagate_nan) {
    auto points = clouds::sheet(400, 5);
    const auto clean = gnomon::estimate_normals(points, knn{12}, plane_pca{});
    for (int i = 0; i < 40; ++i) points.push_back({clouds::nan, 0.1 * i, clouds::infinity});
    const auto mixed = gnomon::estimate_normals(points, knn{12}, plane_pca{});
    for (std::size_t i = 0; i < 400; ++i) EXPECT_EQ(mixed[i].normal, clean[i].normal);
    for (std::size_t i = 400; i < 440; ++i) EXPECT_EQ(mixed[i].trust, trust::not_finite);
}

TEST(estimate_normals, hands_view_points_to_ray_estimators) {
    const auto points = clouds::sheet(50, 6);
    const auto looks_from = [](const Eigen::Vector3d& p, gnomon::neighborhood_view,
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

/// Clouds that are swept, degenerate ones among them, of several chunks where they are not.
std::vector<clouds::named_cloud> swept_clouds() {
    auto all = clouds::degenerate();
    all.push_back({"sheet", clouds::sheet(5000, 7)});
    all.push_back({"cube", clouds::in_cube(5000, 7)});
    all.push_back({"grid", clouds::on_grid(3000, 7, 0.05)});
    all.push_back(
        {"sheet at UTM coordinates",
         clouds::moved(clouds::sheet(3000, 7), Eigen::Matrix3d::Identity(), {6e5, 4.8e6, 100})});
    return all;
}

/// Estimators of every kind receive from a sweep the neighborhoods that the graph lists.
TEST(estimate_normals, sweeps_over_the_neighborhoods_of_the_graph) {
    struct whole_neighborhood : gnomon::normal_fit {
        clouds::cloud neighbors;
    };
    const auto tell = [](const Eigen::Vector3d&, gnomon::neighborhood_view neighbors) {
        return whole_neighborhood{{Eigen::Vector3d::UnitZ(), trust::good},
                                  {neighbors.begin(), neighbors.end()}};
    };
    for (const auto& [name, points] : swept_clouds()) {
        SCOPED_TRACE(name);
        for (const std::size_t k : {1u, 12u}) {
            const auto swept = gnomon::estimate_normals(points, knn{k}, tell);
            const auto stored =
                gnomon::estimate_normals(points, oracles::knn_graph(points, k), tell);
            for (std::size_t i = 0; i < points.size(); ++i) {
                ASSERT_EQ(swept[i].neighbors, stored[i].neighbors);
                ASSERT_EQ(swept[i].neighbors, stored[i].neighbors);
                ASSERT_EQ(swept[i].trust, stored[i].trust);
                ASSERT_EQ(swept[i].mean_distance, stored[i].mean_distance);
            }
        }
    }
}

/// What is summed up on the way, in another order and a vector at a time, is the same but for
/// rounding.
TEST(estimate_normals, of_a_sweep_are_those_of_the_graph) {
    for (const auto& [name, points] : swept_clouds()) {
        SCOPED_TRACE(name);
        const bool crowded = gnomon::spatial_index(points).tree().crowded();
        for (const std::size_t k : {1u, 2u, 9u, 20u, 50u}) {
            const auto swept = gnomon::estimate_normals(points, knn{k}, plane_pca{});
            const auto stored = gnomon::estimate_normals(points, knn{k}(points), plane_pca{});
            for (std::size_t i = 0; i < points.size(); ++i) {
                const auto &a = swept[i], &b = stored[i];
                ASSERT_EQ(a.trust, b.trust) << i;
                ASSERT_EQ(a.neighbors, b.neighbors);
                ASSERT_NEAR(a.mean_distance, b.mean_distance, 1e-14 * b.mean_distance);
                const Eigen::Vector3d lambda = b.spectrum.lambda;
                const double gap = (lambda[1] - lambda[2]) / lambda[0];
                if (gnomon::usable(a.trust)) {
                    ASSERT_LE(laws::angle_between(a.normal, b.normal), oracles::allowed(gap)) << i;
                }
                // Moments are summed about the point, from which all others may be far where many
                // coincide.
                const double far = crowded ? b.mean_distance * b.mean_distance : 0.0;
                for (int e = 0; e < 3; ++e)
                    ASSERT_NEAR(a.spectrum.lambda[e], lambda[e], 1e-14 * (lambda[0] + far));
            }
        }
    }
}

/// Runs chunks in an order of its own: last first, and then odd ones before even ones.
struct shuffling {
    void operator()(std::size_t chunks, std::invocable<std::size_t> auto&& work) const {
        for (const std::size_t parity : {1u, 0u})
            for (std::size_t c = chunks; c-- > 0;)
                if (c % 2 == parity) work(c);
    }
};

/// Batches and guesses end with a chunk; threads take these as they come.
TEST(estimate_normals, of_a_sweep_are_the_same_bytes_for_any_execution) {
    const auto points = clouds::sheet(9001, 8);
    const auto expected = gnomon::estimate_normals(points, knn{15}, plane_pca{});
    const auto expect_same = [&](const auto& surface) {
        for (std::size_t i = 0; i < points.size(); ++i) {
            ASSERT_EQ(surface[i].normal, expected[i].normal);
            ASSERT_EQ(surface[i].spectrum.lambda, expected[i].spectrum.lambda);
            ASSERT_EQ(surface[i].mean_distance, expected[i].mean_distance);
            ASSERT_EQ(surface[i].trust, expected[i].trust);
        }
    };
    for (const unsigned t : {1u, 2u, 4u})
        expect_same(gnomon::estimate_normals(points, knn{15}, plane_pca{}, gnomon::threads{t}));
    expect_same(gnomon::estimate_normals(points, knn{15}, plane_pca{}, shuffling{}));
}

/// An image needs no index; its windows have the normals of the graph, also far from the origin,
/// and the same bytes for any execution.
TEST(estimate_normals, of_an_image_are_those_of_its_graph) {
    const gnomon::constant_noise sigma{0.004};
    const auto near = images::measured(
        images::of_planes({{{0, 0, 1}, 2.0}, {{0.8, 0, 0.6}, 1.3}}, 64, 48), sigma, 0.1, 1);
    const Eigen::Vector3d far(6e5, 4.8e6, 300.0);
    const gnomon::raster pixels{.width = 64, .noise = sigma};
    const auto expected = gnomon::estimate_normals(near, pixels(near), plane_pca{});
    const auto image = clouds::moved(near, Eigen::Matrix3d::Identity(), far);
    const auto seen = gnomon::with_viewpoint(image, far);
    const auto surface = gnomon::estimate_normals(seen, pixels, plane_pca{});
    const auto indexed = gnomon::estimate_normals(gnomon::spatial_index(seen), pixels, plane_pca{});
    const auto shuffled = gnomon::estimate_normals(seen, pixels, plane_pca{}, shuffling{});
    for (std::size_t i = 0; i < image.size(); ++i) {
        ASSERT_EQ(surface[i].trust, expected[i].trust);
        ASSERT_EQ(surface[i].neighbors, expected[i].neighbors);
        ASSERT_EQ(surface[i].trust == trust::not_finite, !gnomon::is_finite(image[i]));
        for (const auto& other : {indexed[i], shuffled[i]}) {
            ASSERT_EQ(other.trust, surface[i].trust);
            ASSERT_EQ(other.normal, surface[i].normal);
            ASSERT_EQ(other.mean_distance, surface[i].mean_distance);
        }
        if (!gnomon::usable(surface[i].trust)) continue;
        // An ulp of the coordinates is 1e-9 m.
        ASSERT_NEAR(surface[i].mean_distance, expected[i].mean_distance, 1e-8);
        ASSERT_LE(laws::angle_between(surface[i].normal, expected[i].normal), 1e-6);
    }
    const auto column = images::of_planes({{{0, 0, 1}, 2.0}}, 1, 48);
    for (const auto& s : gnomon::estimate_normals(column, gnomon::raster{.width = 1}))
        ASSERT_EQ(s.trust, trust::degenerate);  // on one line
    const clouds::cloud nothing(12, Eigen::Vector3d::Constant(clouds::nan));
    for (const auto& s : gnomon::estimate_normals(nothing, gnomon::raster{.width = 4}))
        ASSERT_EQ(s.trust, trust::not_finite);
}

}  // namespace
