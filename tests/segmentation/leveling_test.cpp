// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <stdexcept>

#include <Eigen/LU>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/plane.hpp>
#include <gnomon/segmentation/leveling.hpp>

namespace {

TEST(leveling, is_a_rotation_nearly_upside_down) {
    for (const double tilt : {1e-3, 1e-5, 1e-7, 1e-9, 1e-12}) {
        const Eigen::Vector3d n(std::sin(tilt) * 0.6, std::sin(tilt) * 0.8, -std::cos(tilt));
        const auto level = gnomon::leveling::of({n, 0.0});
        const Eigen::Matrix3d gram = level.rotation.transpose() * level.rotation;
        EXPECT_LT((gram - Eigen::Matrix3d::Identity()).norm(), 1e-9);
    }
}

TEST(leveling, is_a_rotation_for_every_floor) {
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
        const gnomon::plane floor{clouds::random_rotation(seed).col(0), 0.7};
        const auto level = gnomon::leveling::of(floor);
        EXPECT_LT((level.rotation * floor.normal - Eigen::Vector3d::UnitZ()).norm(), 1e-12);
        EXPECT_NEAR(level.rotation.determinant(), 1.0, 1e-12);
        EXPECT_NEAR(level(0.7 * floor.normal).z(), 0.0, 1e-12);
    }
    const auto upside_down = gnomon::leveling::of({-Eigen::Vector3d::UnitZ(), 0.0});
    EXPECT_NEAR(upside_down.rotation.determinant(), 1.0, 1e-12);
    EXPECT_NEAR(upside_down({0, 0, -2}).z(), 2.0, 1e-12);
}

TEST(leveling, rejects_a_normal_that_is_not_of_unit_length) {
    for (const Eigen::Vector3d& bad :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, clouds::nan, 1)})
        EXPECT_THROW((void)gnomon::leveling::of({bad, 0.0}), std::invalid_argument);
}

}  // namespace
