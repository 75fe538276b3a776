// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <gtest/gtest.h>

#include "laws/trajectory_laws.hpp"
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
static_assert(sim::sensor_trajectory<sim::horizontal>);
static_assert(sim::sensor_trajectory<sim::vertical>);
static_assert(sim::sensor_trajectory<sim::rotational>);
static_assert(sim::sensor_trajectory<sim::fixed>);
static_assert(!sim::sensor_trajectory<sim::pose>);

const Eigen::Vector3d forward(1, 0, 0);
const Eigen::Vector3d left(0, 1, 0);

TEST(trajectory, horizontal_yaws_with_upright_lines) {
    const sim::horizontal scan;
    EXPECT_LT((scan(0.0).direction_out(forward) + left).norm(), 1e-15);
    EXPECT_LT((scan(2.0).direction_out(forward) - forward).norm(), 1e-15);
    EXPECT_LT((scan(4.0).direction_out(forward) - left).norm(), 1e-15);
    EXPECT_NEAR(scan(1.3).direction_out(left).z(), 1.0, 1e-15);
}

TEST(trajectory, vertical_pitches_downwards_with_level_lines) {
    const sim::vertical scan;
    EXPECT_NEAR(scan(0.0).direction_out(forward).z(), std::sin(degrees(60).radians()), 1e-15);
    EXPECT_NEAR(scan(4.0).direction_out(forward).z(), -std::sin(degrees(60).radians()), 1e-15);
    EXPECT_LT((scan(1.3).direction_out(left) - left).norm(), 1e-15);
}

TEST(trajectory, rotational_keeps_its_viewing_direction) {
    const sim::rotational scan;
    for (const double t : {0.0, 1.3, 4.0})
        EXPECT_LT((scan(t).direction_out(forward) - forward).norm(), 1e-15);
    EXPECT_NEAR(scan(0.0).direction_out(left).z(), -1.0, 1e-15);
    EXPECT_NEAR(scan(4.0).direction_out(left).z(), 1.0, 1e-15);
}

TEST(trajectory, starts_at_its_mount) {
    const sim::pose mount = sim::at(1, 2, 3) * sim::pitch(degrees(10));
    EXPECT_EQ(sim::vertical{.mount = mount}(1.0).position, mount.position);
    EXPECT_LT((sim::rotational{.mount = mount}(2.0).rotation - mount.rotation).norm(), 1e-15);
}

TEST(trajectory, models_obey_the_laws) {
    const sim::pose mount = sim::at(1, 2, 3) * sim::yaw(degrees(20));
    laws::poses_are_rigid_and_always_the_same(sim::horizontal{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::vertical{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::rotational{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::fixed{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(
        sim::along(2.0, [](double t) { return sim::at(t, 0, 0); }));
}

TEST(trajectory, can_be_any_function_of_time) {
    const sim::along drive(2.0, [](double t) { return sim::at(t, 0, 0); });
    static_assert(sim::sensor_trajectory<decltype(drive)>);
    EXPECT_EQ(drive(1.5).position, Eigen::Vector3d(1.5, 0, 0));
}

}  // namespace
