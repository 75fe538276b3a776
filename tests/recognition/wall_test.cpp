// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/recognition/wall.hpp>

namespace {

using Eigen::Vector3d;

/// At x = 3 before `origin`, 4 m wide and 2 m high, towards lower x.
gnomon::recognition::wall wall_at_3(const Vector3d& origin = {0.0, 0.0, 0.0}) {
    return {{{-1.0, 0.0, 0.0}, -3.0 - origin.x()},
            {.center = origin + Vector3d(3.0, 0.0, 1.0),
             .axes = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
             .lengths = {4.0, 2.0, 0.0}}};
}

TEST(wall, is_before_what_is_behind_it) {
    for (const Vector3d& o : {Vector3d(0.0, 0.0, 0.0), Vector3d(4e5, 5e6, 300.0)}) {
        const auto is_before = [&](double x, double y, double z, double tolerance) {
            return wall_at_3(o).is_before(o + Vector3d(x, y, z), tolerance);
        };
        EXPECT_TRUE(is_before(3.1, 0.0, 1.0, 0.02));
        EXPECT_TRUE(is_before(4.0, 1.5, 0.2, 0.02));
        // In front, or in it up to the tolerance.
        EXPECT_FALSE(is_before(2.9, 0.0, 1.0, 0.02));
        EXPECT_FALSE(is_before(3.01, 0.0, 1.0, 0.02));
        EXPECT_FALSE(is_before(3.1, 0.0, 1.0, 0.2));
        // Behind its plane, but not behind the wall.
        EXPECT_FALSE(is_before(4.0, 2.1, 1.0, 0.02));
        EXPECT_FALSE(is_before(4.0, 0.0, 2.1, 0.02));
        EXPECT_TRUE(is_before(4.0, 2.01, 1.0, 0.02));
    }
    EXPECT_FALSE(wall_at_3().is_before({clouds::nan, 0.0, 1.0}, 0.02));
    EXPECT_FALSE(wall_at_3().is_before({3.1, 0.0, 1.0}, clouds::nan));
}

TEST(wall, has_a_nearest_place) {
    EXPECT_EQ(wall_at_3().foot_of({5.0, 1.0, 0.5}), Vector3d(3.0, 1.0, 0.5));
    EXPECT_EQ(wall_at_3().foot_of({1.0, 9.0, 0.5}), Vector3d(3.0, 9.0, 0.5));
}

}  // namespace
