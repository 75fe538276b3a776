// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/neighborhood_laws.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/ray_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/plane_eif.hpp>

namespace {

using gnomon::constant_noise, gnomon::knn, gnomon::point_index, gnomon::quadratic_noise,
    gnomon::ray_knn;

const Eigen::Vector3d eye(-1.0, 0.5, 2.0);

/// Segments shorter than the neighborhoods, about as long, and far longer.
const std::vector<ray_knn>& policies_of_rays() {
    static const std::vector<ray_knn> all{
        ray_knn{},
        {.k = 1, .noise = constant_noise{0.03}},
        {.k = 9, .noise = constant_noise{0.1}},
        {.k = 40, .noise = constant_noise{1e3}},
        {.k = 20, .noise = constant_noise{0.0}},
        {.k = 30, .noise = quadratic_noise{0.0, 0.01, 0.02}, .sees_across_lines = false}};
    return all;
}

TEST(ray_knn, models_obey_the_laws) {
    for (const ray_knn& policy : policies_of_rays()) {
        for (const auto& [name, points] : clouds::degenerate()) {
            SCOPED_TRACE(name);
            laws::neighborhood_laws(policy, points);
            laws::neighborhood_laws(policy, points, eye);
            laws::neighbors_are_in_canonical_order(policy, points, eye);
            if (!points.empty() && gnomon::is_finite(points[0]))
                laws::neighborhood_laws(policy, points, points[0]);  // a point without a ray
        }
        laws::neighborhood_laws(policy, clouds::in_cube(500, 2), eye);
        laws::neighborhood_laws(policy, clouds::sheet(1000, 2), eye);
    }
}

/// The distance of q from the segment of the ray of p, 4 standard deviations to either side.
double distance_from_ray(const ray_knn& policy, const Eigen::Vector3d& p,
                         const Eigen::Vector3d& q) {
    const Eigen::Vector3d u = (p - eye).normalized();
    const double half = 4.0 * policy.noise((p - eye).norm());
    const double along = std::clamp((q - p).dot(u), -half, half);
    return (q - p - along * u).norm();
}

TEST(ray_knn, agrees_with_brute_force) {
    for (ray_knn policy : policies_of_rays()) {
        policy.sees_across_lines = false;
        for (const auto& points : {clouds::in_cube(600, 1), clouds::sheet(2000, 2, 0.02)}) {
            const auto graph = policy(gnomon::with_viewpoint(points, eye));
            for (std::size_t i = 0; i < points.size(); i += 7) {
                std::vector<double> all, found;
                for (std::size_t j = 0; j < points.size(); ++j)
                    if (j != i) all.push_back(distance_from_ray(policy, points[i], points[j]));
                std::sort(all.begin(), all.end());
                for (const point_index j : graph[i])
                    found.push_back(distance_from_ray(policy, points[i], points[j]));
                std::sort(found.begin(), found.end());
                ASSERT_EQ(found.size(), policy.k);
                for (std::size_t j = 0; j < found.size(); ++j)
                    ASSERT_NEAR(found[j], all[j], 1e-9) << "point " << i << ", rank " << j;
            }
        }
    }
}

TEST(ray_knn, is_knn_without_noise_or_view_points) {
    const auto points = clouds::sheet(1000, 6);
    const auto nearest = knn{.k = 25}(points);
    EXPECT_EQ(ray_knn{.k = 25}(points), nearest);
    const auto seen = gnomon::with_viewpoint(points, eye);
    EXPECT_EQ((ray_knn{.k = 25, .noise = constant_noise{0.0}, .sees_across_lines = false}(seen)),
              nearest);
    EXPECT_FALSE(ray_knn::knows_rays(points));
    EXPECT_TRUE(ray_knn::knows_rays(seen));
    EXPECT_TRUE(ray_knn::knows_rays(gnomon::spatial_index(seen)));
}

/// The mean NEES of plane_eif on a wall whose points are a fifth of the noise apart: its
/// covariances hold with these neighbors, and do not with the nearest ones.
TEST(ray_knn, makes_covariances_hold) {
    constexpr double sigma = 0.02, step = 0.004;
    gnomon::random_stream random(7);
    clouds::cloud points;
    const Eigen::Vector3d normal = Eigen::Vector3d(1.0, 0.3, 0.2).normalized();
    for (double y = -0.3; y < 0.3; y += step)
        for (double z = -0.3; z < 0.3; z += step) {
            const Eigen::Vector3d u = Eigen::Vector3d(2.0, y, z).normalized();
            points.push_back((2.0 / normal.dot(u) + sigma * random.gaussian()) * u);
        }
    const auto seen = gnomon::with_viewpoint(points, Eigen::Vector3d(0.0, 0.0, 0.0));
    const gnomon::plane_eif eif{.noise = constant_noise{sigma}};
    const auto mean_nees = [&](const auto& policy) {
        double sum = 0.0, good = 0.0;
        for (const auto& s : gnomon::estimate_normals(seen, policy, eif)) {
            if (s.trust != gnomon::trust::good) continue;
            sum += gnomon::nees(s, normal);
            good += 1.0;
        }
        EXPECT_GT(good, 0.5 * static_cast<double>(points.size()));
        return sum / good;
    };
    EXPECT_NEAR(mean_nees(ray_knn{.k = 100, .noise = constant_noise{sigma}}), 2.0, 0.2);
    EXPECT_GT(mean_nees(knn{.k = 100}), 3.0);
}

TEST(ray_knn, refuses_bad_parameters) {
    const auto points = clouds::in_cube(20, 1);
    EXPECT_THROW((void)ray_knn{.k = 0}(points), std::invalid_argument);
    const gnomon::spatial_index index(points);
    std::vector<gnomon::neighbor> found;
    EXPECT_THROW(ray_knn{.k = 0}.find(index, 0, found), std::invalid_argument);
}

}  // namespace
