// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <gtest/gtest.h>

#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace {

using gnomon::degrees;
static_assert(gnomon::sensor_trajectory<gnomon::horizontal>);
static_assert(gnomon::sensor_trajectory<gnomon::vertical>);
static_assert(gnomon::sensor_trajectory<gnomon::rotational>);
static_assert(gnomon::sensor_trajectory<gnomon::fixed>);
static_assert(!gnomon::sensor_trajectory<gnomon::pose>);

const Eigen::Vector3d forward(1, 0, 0);
const Eigen::Vector3d left(0, 1, 0);

TEST(trajectory, horizontal_yaws_with_upright_lines) {
    const gnomon::horizontal scan;
    EXPECT_LT((scan(0.0).direction_out(forward) + left).norm(), 1e-15);
    EXPECT_LT((scan(2.0).direction_out(forward) - forward).norm(), 1e-15);
    EXPECT_LT((scan(4.0).direction_out(forward) - left).norm(), 1e-15);
    EXPECT_NEAR(scan(1.3).direction_out(left).z(), 1.0, 1e-15);
}

TEST(trajectory, vertical_pitches_downwards_with_level_lines) {
    const gnomon::vertical scan;
    EXPECT_NEAR(scan(0.0).direction_out(forward).z(), std::sin(degrees(60).radians()), 1e-15);
    EXPECT_NEAR(scan(4.0).direction_out(forward).z(), -std::sin(degrees(60).radians()), 1e-15);
    EXPECT_LT((scan(1.3).direction_out(left) - left).norm(), 1e-15);
}

TEST(trajectory, rotational_keeps_its_axis_of_sight) {
    const gnomon::rotational scan;
    for (const double t : {0.0, 1.3, 4.0})
        EXPECT_LT((scan(t).direction_out(forward) - forward).norm(), 1e-15);
    EXPECT_NEAR(scan(0.0).direction_out(left).z(), -1.0, 1e-15);
    EXPECT_NEAR(scan(4.0).direction_out(left).z(), 1.0, 1e-15);
}

TEST(trajectory, goes_on_from_its_mount) {
    const gnomon::pose mount = gnomon::at(1, 2, 3) * gnomon::pitch(degrees(10));
    EXPECT_EQ(gnomon::vertical{.mount = mount}(1.0).position, mount.position);
    EXPECT_LT((gnomon::rotational{.mount = mount}(2.0).rotation - mount.rotation).norm(), 1e-15);
}

/// The law of the concept: at every time a rigid motion, always the same.
TEST(trajectory, is_a_rigid_motion_at_every_time) {
    const gnomon::pose mount = gnomon::at(1, 2, 3) * gnomon::yaw(degrees(20));
    const auto check = [](const auto& trajectory) {
        for (int k = 0; k <= 100; ++k) {
            const double t = trajectory.duration * k / 100.0;
            EXPECT_TRUE(gnomon::is_rigid(trajectory(t)));
            EXPECT_EQ(trajectory(t).rotation, trajectory(t).rotation);
            EXPECT_EQ(trajectory(t).position, trajectory(t).position);
        }
    };
    check(gnomon::horizontal{.mount = mount});
    check(gnomon::vertical{.mount = mount});
    check(gnomon::rotational{.mount = mount});
    check(gnomon::fixed{.mount = mount});
    check(gnomon::along(2.0, [](double t) { return gnomon::at(t, 0, 0); }));
}

TEST(trajectory, may_be_any_function_of_time) {
    const gnomon::along drive(2.0, [](double t) { return gnomon::at(t, 0, 0); });
    static_assert(gnomon::sensor_trajectory<decltype(drive)>);
    EXPECT_EQ(drive(1.5).position, Eigen::Vector3d(1.5, 0, 0));
}

}  // namespace
