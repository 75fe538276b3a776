// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "simulation/furnished.hpp"
#include <gnomon/simulation/chair.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::chair;

TEST(chair, names_its_parts) {
    using names = std::set<std::string>;
    const chair throne{.back = sim::chair_back::ladder, .arm_height = 0.66};
    EXPECT_EQ(furnished::parts_of(throne),
              (names{"seat", "back", "leg 1", "leg 2", "leg 3", "leg 4", "arm left", "arm right"}));
    const chair pouf{.back = sim::chair_back::none, .massive = true};
    EXPECT_EQ(furnished::parts_of(pouf), names{"seat"});
}

TEST(chair, is_as_large_as_its_measures) {
    furnished::expect_extent(chair{.width = 0.5, .depth = 0.4}, {-0.2, -0.25, 0.0},
                             {0.2, 0.25, 0.9});
}

/// The seat is a disc of the width; the legs stand below it, whatever depth says.
TEST(chair, stands_within_its_round_seat) {
    const chair stool{.width = 0.3, .depth = 0.6, .back = sim::chair_back::none, .round = true};
    furnished::expect_extent(stool, {-0.15, -0.15, 0.0}, {0.15, 0.15, 0.45});
}

TEST(chair, scales_all_its_measures) {
    furnished::expect_scales(chair{.back = sim::chair_back::lattice, .arm_height = 0.66});
}

TEST(chair, refuses_measures_that_do_not_fit) {
    sim::scene world;
    EXPECT_THROW(sim::add(world, "chair", chair{.width = -1.0}), std::invalid_argument);
    EXPECT_THROW(sim::add(world, "chair", chair{.seat_height = 0.02}), std::invalid_argument);
}

}  // namespace
