// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/detail/least_squares_quadric.hpp>
#include <gnomon/core/random.hpp>

namespace {

/// Weights count points, and what is left is the sum of squares over the surface found.
TEST(least_squares_quadric, weighs_points_and_says_what_is_left) {
    gnomon::random_stream random(3);
    gnomon::detail::least_squares_quadric weighted, repeated;
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 40; ++i) {
        const double x = random.uniform(-1.0, 1.0), y = random.uniform(-1.0, 1.0);
        const double z = 0.3 + x - 0.5 * y + x * y + random.uniform(-0.1, 0.1);
        weighted.add(x, y, z, 1.0 + i % 3);
        for (int j = 0; j <= i % 3; ++j) {
            repeated.add(x, y, z);
            points.emplace_back(x, y, z);
        }
    }
    ASSERT_GT(weighted.solve(), 0.1);
    ASSERT_GT(repeated.solve(), 0.1);
    const auto q = weighted.solution(1.0, 1.0);
    double left = 0.0;
    for (const Eigen::Vector3d& p : points) {
        left += (p.z() - q(p.x(), p.y())) * (p.z() - q(p.x(), p.y()));
    }
    EXPECT_NEAR(q.constant, repeated.solution(1.0, 1.0).constant, 1e-12);
    EXPECT_NEAR(weighted.squared_residual(), left, 1e-12);
}

}  // namespace
