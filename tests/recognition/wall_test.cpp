// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/recognition/wall.hpp>

namespace {

using Eigen::Vector3d;

/// At x = 3, 4 m wide and 2 m high, seen from x = 0.
gnomon::recognition::wall wall_at_3() {
    return {{{-1.0, 0.0, 0.0}, -3.0},
            {.center = {3.0, 0.0, 1.0},
             .axes = (Eigen::Matrix3d() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished(),
             .lengths = {4.0, 2.0, 0.0}}};
}

const Vector3d eye(0.0, 0.0, 1.0);

/// The observed range is that of the wall, where the wall is.
bool hides_behind_wall(const Vector3d& at, double tolerance = 0.02) {
    const double range = (at - eye).norm() * 3.0 / at.x();
    return wall_at_3().hides(at, eye, range, tolerance);
}

TEST(wall, hides_places_behind_it) {
    EXPECT_TRUE(hides_behind_wall({3.1, 0.0, 1.0}));
    EXPECT_TRUE(hides_behind_wall({4.0, 1.5, 0.2}));
    // In front, or in it up to the tolerance.
    EXPECT_FALSE(hides_behind_wall({2.9, 0.0, 1.0}));
    EXPECT_FALSE(hides_behind_wall({3.01, 0.0, 1.0}));
    EXPECT_FALSE(hides_behind_wall({3.1, 0.0, 1.0}, 0.2));
}

/// What is in its plane elsewhere is not the wall.
TEST(wall, hides_nothing_next_to_it) {
    EXPECT_FALSE(hides_behind_wall({4.0, 3.0, 1.0}));
    EXPECT_FALSE(hides_behind_wall({3.5, 0.0, 3.0}));
    EXPECT_TRUE(hides_behind_wall({3.5, 2.34, 1.0}, 0.05));  // 5 mm next to it
}

/// What something else hides, or the sensor sees, is not hidden by the wall.
TEST(wall, hides_nothing_that_is_seen_or_hidden_by_others) {
    const Vector3d at(3.5, 0.0, 1.0);
    for (const double range : {2.0, 2.9, 3.1, 3.5, 5.0, -1.0, clouds::nan})
        EXPECT_FALSE(wall_at_3().hides(at, eye, range, 0.02)) << range;
    EXPECT_TRUE(wall_at_3().hides(at, eye, 3.01, 0.02));
    EXPECT_FALSE(gnomon::recognition::wall().hides({0.0, 0.0, -1.0}, eye, 1.5, 0.02));
    EXPECT_FALSE(wall_at_3().hides({clouds::nan, 0.0, 1.0}, eye, 3.0, 0.02));
}

}  // namespace
