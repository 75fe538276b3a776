// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/scene.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(scene, finds_its_surfaces_by_number_and_name) {
    sim::scene world;
    const auto table = world.add_object("table");
    const auto top = world.add_part(table, "top");
    const auto leg = world.add_part(table, "leg");
    EXPECT_EQ(world.add(top, sim::box{1, 1, 0.03}), 0);
    EXPECT_EQ(world.add(leg, sim::cylinder{0.02, 0.7}), 6);
    EXPECT_EQ(world.surfaces().size(), 9u);
    EXPECT_EQ(world.surface_name(4), "table/top/+z");
    EXPECT_EQ(world.find_surface("table/leg/mantle"), 6);
    EXPECT_EQ(world.find_surface("table/leg/lid"), sim::nothing);
    EXPECT_EQ(world.parts()[static_cast<std::size_t>(world.surfaces()[7].part)].name, "leg");
}

TEST(scene, takes_an_object_of_one_shape_at_once) {
    sim::scene world;
    EXPECT_GT(world.extent().low.x(), world.extent().high.x());
    EXPECT_EQ(world.add_object("table", sim::box{1, 1, 1}, sim::at(3, 0, 0.5)), 0);
    EXPECT_EQ(world.add_object("lamp", sim::cylinder{0.5, 2}), 6);
    EXPECT_EQ(world.objects(), (std::vector<std::string>{"table", "lamp"}));
    EXPECT_EQ(world.surface_name(6), "lamp/body/mantle");
    EXPECT_LT((world.extent().low - Eigen::Vector3d(-0.5, -0.5, 0)).norm(), 1e-9);
    EXPECT_LT((world.extent().high - Eigen::Vector3d(3.5, 0.5, 2)).norm(), 1e-9);
}

TEST(scene, turns_and_moves_shapes) {
    sim::scene world;
    world.add_object("box", sim::box{2, 0.2, 0.2},
                     sim::at(3, 0, 0) * sim::yaw(gnomon::degrees(90)));
    const auto hit = world.shapes().front().first_hit({{0, 0.9, 0}, {1, 0, 0}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range, 2.9, 1e-12);
    EXPECT_LT((hit->normal - Eigen::Vector3d(-1, 0, 0)).norm(), 1e-12);
    EXPECT_EQ(world.surface_name(hit->surface), "box/body/+y");
}

TEST(scene, rejects_invalid_input) {
    sim::scene world;
    EXPECT_THROW(world.add_part(0, "part of nothing"), std::invalid_argument);
    const auto part = world.add_part(world.add_object("object"), "part");
    EXPECT_THROW(world.add(part + 1, sim::box{1, 1, 1}), std::invalid_argument);
    EXPECT_THROW(world.add(-1, sim::box{1, 1, 1}), std::invalid_argument);
    for (const double bad : {-1.0, clouds::nan, clouds::infinity, 1e200}) {
        EXPECT_THROW(world.add(part, sim::box{bad, 1, 1}), std::invalid_argument);
        EXPECT_THROW(world.add(part, sim::cylinder{bad, 1}), std::invalid_argument);
        EXPECT_THROW(world.add(part, sim::cylinder{1, bad}), std::invalid_argument);
    }
    sim::pose skewed;
    skewed.rotation(0, 1) = 0.5;
    EXPECT_THROW(world.add(part, sim::box{1, 1, 1}, skewed), std::invalid_argument);
    sim::pose mirrored;
    mirrored.rotation(0, 0) = -1.0;
    EXPECT_THROW(world.add(part, sim::box{1, 1, 1}, mirrored), std::invalid_argument);
    EXPECT_THROW(world.add(part, sim::box{1, 1, 1}, sim::at(clouds::nan, 0, 0)),
                 std::invalid_argument);
    EXPECT_TRUE(world.shapes().empty());
    EXPECT_TRUE(world.surfaces().empty());
}

}  // namespace
