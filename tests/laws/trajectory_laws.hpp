// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `sensor_trajectory` concept, for any model: yours, too.
#pragma once

#include <gtest/gtest.h>

#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace laws {

// [poses_are_rigid_and_always_the_same]
/// At each time from 0 to the duration the pose is a rigid motion, the same each time it is
/// computed.
template <gnomon::simulation::sensor_trajectory T>
void poses_are_rigid_and_always_the_same(const T& trajectory) {
    ASSERT_GE(trajectory.duration, 0.0);
    for (int k = 0; k <= 100; ++k) {
        const double t = trajectory.duration * k / 100.0;
        ASSERT_TRUE(gnomon::is_rigid(trajectory(t)));
        ASSERT_EQ(trajectory(t).rotation, trajectory(t).rotation);
        ASSERT_EQ(trajectory(t).position, trajectory(t).position);
    }
}
// [poses_are_rigid_and_always_the_same]

}  // namespace laws
