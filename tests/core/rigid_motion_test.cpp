// SPDX-License-Identifier: BSL-1.0
#include <cstdint>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/core/rigid_motion.hpp>

namespace {

gnomon::rigid_motion any_motion(std::uint64_t seed) {
    gnomon::random_stream random(seed, 3);
    return {clouds::random_rotation(seed), clouds::gaussian_vector(random)};
}

TEST(rigid_motion, inverse_undoes_it) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const gnomon::rigid_motion m = any_motion(seed), back = m.inverse();
        const Eigen::Vector3d p(1, -2, 3);
        EXPECT_LT((back.point_out(m.point_out(p)) - p).norm(), 1e-13);
        EXPECT_LT((back.point_out(p) - m.point_in(p)).norm(), 1e-13);
        EXPECT_TRUE(gnomon::is_rigid(back));
        const gnomon::rigid_motion none = m * back;
        EXPECT_LT((none.rotation - Eigen::Matrix3d::Identity()).norm(), 1e-13);
        EXPECT_LT(none.position.norm(), 1e-13);
    }
}

TEST(rigid_motion, stands_on_the_ground) {
    const auto m = gnomon::rigid_motion::on_ground(2.0, -1.0, gnomon::degrees(90));
    EXPECT_LT((m.point_out({1, 0, 5}) - Eigen::Vector3d(2, 0, 5)).norm(), 1e-14);
    EXPECT_TRUE(gnomon::is_rigid(m));
}

}  // namespace
