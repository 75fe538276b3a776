// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/simulation/ray.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(ray, points_lie_along_it) {
    const sim::ray r{{1, 2, 3}, {0, 0, 1}};
    EXPECT_EQ(r.point_at(2.0), Eigen::Vector3d(1, 2, 5));
}

}  // namespace
