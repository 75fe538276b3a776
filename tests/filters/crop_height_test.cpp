// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/filters/crop_height.hpp>

namespace {

/// Oracle: heights in the frame of the floor, compared one by one.
TEST(crop_height, keeps_the_points_between_floor_and_ceiling) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Eigen::Matrix3d turn = clouds::random_rotation(seed);
        const Eigen::Vector3d shift(4e5, 5e6, 100.0);
        auto level = clouds::in_cube(500, seed);
        level[7].x() = clouds::nan;
        level[8].z() = clouds::infinity;
        const auto points = clouds::moved(level, turn, shift);
        const gnomon::plane floor{turn.col(2), turn.col(2).dot(shift)};
        for (const std::optional<double> ceiling : {std::optional<double>(0.9), {}}) {
            const auto kept =
                gnomon::crop_height(points, floor, ceiling, {.floor = 0.1, .ceiling = 0.2});
            std::vector<gnomon::point_index> expected;
            for (gnomon::point_index i = 0; i < level.size(); ++i) {
                if (!gnomon::is_finite(level[i]) || !(level[i].z() > 0.1)) continue;
                if (!ceiling || level[i].z() < 0.7) expected.push_back(i);
            }
            EXPECT_EQ(kept, expected);
        }
    }
}

TEST(crop_height, leaves_out_the_bands_themselves) {
    const clouds::cloud points{{0, 0, 0.05}, {0, 0, 0.0625}, {0, 0, 2.4375}, {0, 0, 2.45}};
    EXPECT_EQ(gnomon::crop_height(points, gnomon::plane{}, 2.5),
              (std::vector<gnomon::point_index>{1, 2}));
    for (const auto& [name, cloud] : clouds::degenerate())
        EXPECT_LE(gnomon::crop_height(cloud, gnomon::plane{}, 2.5).size(), cloud.size()) << name;
}

TEST(crop_height, refuses_heights_that_are_no_numbers) {
    const auto points = clouds::in_cube(10, 1);
    for (const Eigen::Vector3d& bad :
         {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, clouds::nan)})
        EXPECT_THROW((void)gnomon::crop_height(points, {bad, 0.0}, {}), std::invalid_argument);
    EXPECT_THROW((void)gnomon::crop_height(points, gnomon::plane{}, clouds::nan),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::crop_height(points, gnomon::plane{}, {}, {.floor = clouds::nan}),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::crop_height(points, gnomon::plane{}, {}, {.ceiling = clouds::nan}),
                 std::invalid_argument);
}

}  // namespace
