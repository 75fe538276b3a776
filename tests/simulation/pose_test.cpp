// SPDX-License-Identifier: BSL-1.0
#include <cstdint>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/pose.hpp>

namespace {

using gnomon::degrees;

gnomon::pose any_pose(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    const auto angle = [&] { return degrees(random.uniform(-180, 180)); };
    return gnomon::at(random.gaussian(), random.gaussian(), random.gaussian()) *
           gnomon::yaw(angle()) * gnomon::pitch(angle()) * gnomon::roll(angle());
}

TEST(pose, out_and_in_are_inverse) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const gnomon::pose a = any_pose(seed);
        const Eigen::Vector3d p(1, -2, 3);
        EXPECT_LT((a.point_in(a.point_out(p)) - p).norm(), 1e-14);
        EXPECT_LT((a.direction_out(a.direction_in(p)) - p).norm(), 1e-14);
        EXPECT_LT((a.rotation.transpose() * a.rotation - Eigen::Matrix3d::Identity()).norm(),
                  1e-14);
    }
}

TEST(pose, knows_whether_it_is_a_rigid_motion) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) EXPECT_TRUE(gnomon::is_rigid(any_pose(seed)));
    gnomon::pose doubled;
    doubled.rotation *= 2.0;
    gnomon::pose flat;
    flat.rotation.setZero();
    gnomon::pose mirrored;
    mirrored.rotation(0, 0) = -1.0;
    gnomon::pose skewed;
    skewed.rotation(0, 1) = 1e-8;
    gnomon::pose unknown;
    unknown.rotation(2, 1) = clouds::nan;
    for (const gnomon::pose& bad :
         {doubled, flat, mirrored, skewed, unknown, gnomon::at(0, clouds::nan, 0),
          gnomon::at(0, 0, clouds::infinity)}) {
        EXPECT_FALSE(gnomon::is_rigid(bad));
    }
}

TEST(pose, composes) {
    const gnomon::pose a = any_pose(1);
    const gnomon::pose b = any_pose(2);
    const Eigen::Vector3d p(1, -2, 3);
    EXPECT_LT(((a * b).point_out(p) - a.point_out(b.point_out(p))).norm(), 1e-14);
}

TEST(pose, turns_the_way_the_words_say) {
    const Eigen::Vector3d forward(1, 0, 0);
    const Eigen::Vector3d left(0, 1, 0);
    const Eigen::Vector3d up(0, 0, 1);
    EXPECT_LT((gnomon::yaw(degrees(90)).direction_out(forward) - left).norm(), 1e-15);
    EXPECT_LT((gnomon::pitch(degrees(90)).direction_out(forward) + up).norm(), 1e-15);
    EXPECT_LT((gnomon::roll(degrees(90)).direction_out(left) - up).norm(), 1e-15);
}

}  // namespace
