// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/core/plane.hpp>

TEST(plane, distance_is_positive_on_the_side_of_the_normal) {
    const gnomon::plane p{Eigen::Vector3d::UnitX(), 2.0};
    EXPECT_DOUBLE_EQ(p.signed_distance({5, 1, 1}), 3.0);
    EXPECT_DOUBLE_EQ(p.signed_distance({0, 7, 7}), -2.0);
}
