// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <gtest/gtest.h>

#include "laws/trajectory_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
static_assert(sim::sensor_trajectory<sim::horizontal>);
static_assert(sim::sensor_trajectory<sim::vertical>);
static_assert(sim::sensor_trajectory<sim::rotational>);
static_assert(sim::sensor_trajectory<sim::fixed>);
static_assert(sim::sensor_trajectory<sim::driving>);
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

/// In any direction, with any turn.
sim::driving any_drive(gnomon::random_stream& random) {
    sim::driving drive{.mount = sim::at(1, 2, 3) * sim::pitch(degrees(random.uniform(-20, 20)))};
    drive.duration = random.uniform(0.1, 5.0);
    for (double& component : drive.velocity) component = random.uniform(-20.0, 20.0);
    drive.turn_per_second = degrees(random.uniform(-90.0, 90.0));
    return drive;
}

TEST(trajectory, models_obey_the_laws) {
    const sim::pose mount = sim::at(1, 2, 3) * sim::yaw(degrees(20));
    laws::poses_are_rigid_and_always_the_same(sim::horizontal{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::vertical{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::rotational{.mount = mount});
    laws::poses_are_rigid_and_always_the_same(sim::fixed{.mount = mount});
    gnomon::random_stream random(20'001);
    for (int trial = 0; trial < 50; ++trial)
        laws::poses_are_rigid_and_always_the_same(any_drive(random));
    laws::poses_are_rigid_and_always_the_same(
        sim::along(2.0, [](double t) { return sim::at(t, 0, 0); }));
}

/// The oracle: many short steps, each with the direction of its middle.
TEST(trajectory, driving_integrates_its_velocity) {
    gnomon::random_stream random(20'002);
    for (int trial = 0; trial < 20; ++trial) {
        const sim::driving drive = any_drive(random);
        constexpr int steps = 10'000;
        const double step = drive.duration / steps;
        Eigen::Vector3d position = drive.mount.position;
        for (int i = 0; i < steps; ++i)
            position += step * drive((i + 0.5) * step).direction_out(drive.velocity);
        EXPECT_LT((drive(drive.duration).position - position).norm(), 1e-6);
        const auto turned = gnomon::radians(drive.duration * drive.turn_per_second.radians());
        const sim::pose heading = drive.mount * sim::yaw(turned);
        EXPECT_LT((drive(drive.duration).rotation - heading.rotation).norm(), 1e-12);
    }
}

TEST(trajectory, driving_without_turns_is_straight) {
    const sim::driving drive{.mount = sim::at(1, 2, 3) * sim::yaw(degrees(90))};
    EXPECT_EQ(drive(0.0).position, drive.mount.position);
    EXPECT_LT((drive(0.1).position - Eigen::Vector3d(1, 3.5, 3)).norm(), 1e-15);
    EXPECT_EQ(drive(0.1).rotation, drive.mount.rotation);
    // It is the limit of driving with hardly any turn.
    sim::driving hardly = drive;
    hardly.turn_per_second = gnomon::radians(1e-9);
    EXPECT_LT((hardly(0.1).position - drive(0.1).position).norm(), 1e-9);
}

TEST(trajectory, can_be_any_function_of_time) {
    const sim::along drive(2.0, [](double t) { return sim::at(t, 0, 0); });
    static_assert(sim::sensor_trajectory<decltype(drive)>);
    EXPECT_EQ(drive(1.5).position, Eigen::Vector3d(1.5, 0, 0));
}

}  // namespace
