// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/simulation/box_and_cylinder.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::box_and_cylinder;

TEST(box_and_cylinder, returns_14200_points_within_one_percent_at_every_scale) {
    for (const double scale : {0.5, 0.85, 1.0, 1.15, 1.5}) {
        const auto n = sim::simulate(box_and_cylinder{.scale = scale}).scan.size();
        EXPECT_NEAR(static_cast<double>(n), 14'200.0, 142.0) << scale;
    }
}

/// Small objects have ragged outlines: among few points a ray more or less counts.
TEST(box_and_cylinder, returns_few_points_within_three_percent) {
    for (const double scale : {0.1, 0.3, 0.7, 1.0, 1.5}) {
        for (const std::size_t points : {1000u, 1500u, 3000u}) {
            const auto n =
                sim::simulate(box_and_cylinder{.scale = scale, .points = points}).scan.size();
            const auto wanted = static_cast<double>(points);
            EXPECT_NEAR(static_cast<double>(n), wanted, 0.03 * wanted) << scale;
        }
    }
}

/// Without noise every point lies on its surface, and the sensor sees its outer side.
TEST(box_and_cylinder, ground_truth_is_true) {
    const auto truth = sim::simulate(box_and_cylinder{.sigma = 0.0});
    const Eigen::Vector3d sensor = truth.scan.viewpoints[0];
    EXPECT_EQ(sensor, Eigen::Vector3d(0, 0, 0.8));
    const Eigen::Vector3d box(2.2, -0.55, 0.3);
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d& p = truth.scan.points[i];
        const Eigen::Vector3d& n = truth.normals[i];
        EXPECT_NEAR(n.norm(), 1.0, 1e-12);
        EXPECT_LT(n.dot(p - sensor), 0.0);
        switch (truth.surfaces[i]) {
            case 6:
                EXPECT_NEAR((p.head<2>() - Eigen::Vector2d(2.4, 0.55)).norm(), 0.3, 1e-12);
                break;
            case 8:
                EXPECT_NEAR(p.z(), 0.9, 1e-12);
                break;
            default:
                EXPECT_NEAR(n.dot(p - box), 0.3, 1e-12);
        }
    }
}

/// Noise lies along the ray and has the given deviation (within four standard errors).
TEST(box_and_cylinder, noise_is_along_the_ray) {
    const auto ideal = sim::simulate(box_and_cylinder{.sigma = 0.0});
    const auto noisy = sim::simulate(box_and_cylinder{.sigma = 0.02, .seed = 5});
    ASSERT_EQ(ideal.scan.size(), noisy.scan.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < ideal.scan.size(); ++i) {
        const Eigen::Vector3d v = ideal.scan.viewpoints[i];
        const Eigen::Vector3d u = (ideal.scan.points[i] - v).normalized();
        const Eigen::Vector3d d = noisy.scan.points[i] - ideal.scan.points[i];
        EXPECT_LT((d - d.dot(u) * u).norm(), 1e-12);
        sum += d.squaredNorm();
    }
    const double n = static_cast<double>(ideal.scan.size());
    EXPECT_NEAR(std::sqrt(sum / n), 0.02, 4 * 0.02 / std::sqrt(2 * n));
}

TEST(box_and_cylinder, is_the_same_for_the_same_seed_only) {
    const auto a = sim::simulate(box_and_cylinder{.seed = 1});
    EXPECT_EQ(a.scan.points, sim::simulate(box_and_cylinder{.seed = 1}).scan.points);
    EXPECT_NE(a.scan.points, sim::simulate(box_and_cylinder{.seed = 2}).scan.points);
}

TEST(box_and_cylinder, refuses_impossible_scenes) {
    for (const auto& bad :
         {box_and_cylinder{.sigma = -1}, box_and_cylinder{.sigma = clouds::nan},
          box_and_cylinder{.scale = 0.01}, box_and_cylinder{.scale = clouds::infinity},
          box_and_cylinder{.points = 0}, box_and_cylinder{.scale = 0.1, .points = 10'000'000}}) {
        EXPECT_THROW((void)sim::simulate(bad), std::invalid_argument);
    }
}

}  // namespace
