// SPDX-License-Identifier: BSL-1.0
#include <cstdint>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/pose.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;

sim::pose any_pose(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    const auto angle = [&] { return degrees(random.uniform(-180, 180)); };
    return sim::at(random.gaussian(), random.gaussian(), random.gaussian()) * sim::yaw(angle()) *
           sim::pitch(angle()) * sim::roll(angle());
}

TEST(pose, out_and_in_are_inverse) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const sim::pose a = any_pose(seed);
        const Eigen::Vector3d p(1, -2, 3);
        EXPECT_LT((a.point_in(a.point_out(p)) - p).norm(), 1e-14);
        EXPECT_LT((a.direction_out(a.direction_in(p)) - p).norm(), 1e-14);
        EXPECT_LT((a.rotation.transpose() * a.rotation - Eigen::Matrix3d::Identity()).norm(),
                  1e-14);
    }
}

TEST(pose, detects_rigid_motions) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) EXPECT_TRUE(gnomon::is_rigid(any_pose(seed)));
    sim::pose doubled;
    doubled.rotation *= 2.0;
    sim::pose flat;
    flat.rotation.setZero();
    sim::pose mirrored;
    mirrored.rotation(0, 0) = -1.0;
    sim::pose skewed;
    skewed.rotation(0, 1) = 1e-8;
    sim::pose unknown;
    unknown.rotation(2, 1) = clouds::nan;
    for (const sim::pose& bad : {doubled, flat, mirrored, skewed, unknown,
                                 sim::at(0, clouds::nan, 0), sim::at(0, 0, clouds::infinity)}) {
        EXPECT_FALSE(gnomon::is_rigid(bad));
    }
}

TEST(pose, composes) {
    const sim::pose a = any_pose(1);
    const sim::pose b = any_pose(2);
    const Eigen::Vector3d p(1, -2, 3);
    EXPECT_LT(((a * b).point_out(p) - a.point_out(b.point_out(p))).norm(), 1e-14);
}

TEST(pose, turns_the_way_the_words_say) {
    const Eigen::Vector3d forward(1, 0, 0);
    const Eigen::Vector3d left(0, 1, 0);
    const Eigen::Vector3d up(0, 0, 1);
    EXPECT_LT((sim::yaw(degrees(90)).direction_out(forward) - left).norm(), 1e-15);
    EXPECT_LT((sim::pitch(degrees(90)).direction_out(forward) + up).norm(), 1e-15);
    EXPECT_LT((sim::roll(degrees(90)).direction_out(left) - up).norm(), 1e-15);
}

}  // namespace
