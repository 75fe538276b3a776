// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include <gnomon/simulation/chair.hpp>

namespace {

using gnomon::chair;

std::set<std::string> parts_of(const gnomon::scene& world) {
    std::set<std::string> parts;
    for (const auto& part : world.parts()) parts.insert(part.name);
    return parts;
}

TEST(chair, names_its_parts) {
    gnomon::scene world;
    gnomon::add(world, "throne", chair{.back = gnomon::chair_back::ladder, .arm_height = 0.66});
    EXPECT_EQ(parts_of(world), (std::set<std::string>{"seat", "back", "leg 1", "leg 2", "leg 3",
                                                      "leg 4", "arm left", "arm right"}));
    gnomon::scene pouf;
    gnomon::add(pouf, "pouf", chair{.back = gnomon::chair_back::none, .massive = true});
    EXPECT_EQ(parts_of(pouf), std::set<std::string>{"seat"});
}

TEST(chair, is_as_large_as_its_measures) {
    gnomon::scene world;
    gnomon::add(world, "chair", chair{.width = 0.5, .depth = 0.4});
    const gnomon::bounds extent = world.extent();
    EXPECT_LT((extent.low - Eigen::Vector3d(-0.2, -0.25, 0.0)).norm(), 1e-9);
    EXPECT_LT((extent.high - Eigen::Vector3d(0.2, 0.25, 0.9)).norm(), 1e-9);
}

/// The seat is a disc of the width; the legs stand below it, whatever depth says.
TEST(chair, stands_within_its_round_seat) {
    gnomon::scene world;
    gnomon::add(world, "stool",
                chair{.width = 0.3, .depth = 0.6, .back = gnomon::chair_back::none, .round = true});
    const gnomon::bounds extent = world.extent();
    EXPECT_LT((extent.low - Eigen::Vector3d(-0.15, -0.15, 0.0)).norm(), 1e-9);
    EXPECT_LT((extent.high - Eigen::Vector3d(0.15, 0.15, 0.45)).norm(), 1e-9);
}

TEST(chair, scales_all_its_measures) {
    const chair c{.back = gnomon::chair_back::lattice, .arm_height = 0.66};
    gnomon::scene once;
    gnomon::scene twice;
    gnomon::add(once, "chair", c);
    gnomon::add(twice, "chair", scaled(c, 2.0));
    ASSERT_EQ(once.shapes().size(), twice.shapes().size());
    for (std::size_t i = 0; i < once.shapes().size(); ++i) {
        const gnomon::bounds& a = once.shapes()[i].extent;
        const gnomon::bounds& b = twice.shapes()[i].extent;
        EXPECT_LT((2.0 * a.low - b.low).norm(), 1e-9);
        EXPECT_LT((2.0 * a.high - b.high).norm(), 1e-9);
    }
}

TEST(chair, refuses_measures_that_do_not_fit) {
    gnomon::scene world;
    EXPECT_THROW(gnomon::add(world, "chair", chair{.width = -1.0}), std::invalid_argument);
    EXPECT_THROW(gnomon::add(world, "chair", chair{.seat_height = 0.02}), std::invalid_argument);
}

}  // namespace
