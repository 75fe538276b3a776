// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::scenes::furnished_room;

TEST(furnished_room, differs_from_seed_to_seed_only) {
    const auto a = furnished_room({.seed = 1});
    EXPECT_EQ(a.objects(), furnished_room({.seed = 1}).objects());
    EXPECT_EQ(a.shapes().back().pose.position,
              furnished_room({.seed = 1}).shapes().back().pose.position);
    EXPECT_NE(a.shapes().front().extent.high,
              furnished_room({.seed = 2}).shapes().front().extent.high);
}

/// No piece is within another or in a wall, and the sensor stands free.
TEST(furnished_room, keeps_its_pieces_apart) {
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
        const auto world = furnished_room({.pieces = 12, .seed = seed});
        EXPECT_GT(world.objects().size(), 6u);
        const auto& room = world.shapes();  // floor, ceiling, walls: the first six
        for (std::size_t i = 6; i < room.size(); ++i) {
            for (int a = 0; a < 2; ++a) {
                EXPECT_GE(room[i].extent.low[a], room[0].extent.low[a] - 1e-9);
                EXPECT_LE(room[i].extent.high[a], room[0].extent.high[a] + 1e-9);
            }
            EXPECT_LT(room[i].extent.high.z(), room[1].extent.high.z());
        }
        const auto truth = sim::simulate(world, sim::rotational{.mount = world.sensor});
        EXPECT_EQ(truth.scan.size(), 115'200u);
        for (const double range : truth.ranges) EXPECT_GT(range, 0.2);
    }
}

TEST(furnished_room, can_be_empty_or_full) {
    EXPECT_EQ(furnished_room({.pieces = 0}).objects().size(), 2u);
    EXPECT_LT(furnished_room({.pieces = 1000}).objects().size(), 100u);
    EXPECT_THROW((void)furnished_room({.pieces = -1}), std::invalid_argument);
}

}  // namespace
