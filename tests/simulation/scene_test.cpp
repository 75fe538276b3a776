// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>

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

/// Furniture of all types of shape in a pose of its own, and an opening.
sim::scene desk_corner() {
    sim::scene model;
    const auto pieces = sim::furniture_models();
    sim::add(model, pieces[3], sim::at(0.6, 0.2, 0) * sim::yaw(gnomon::degrees(20)));
    sim::add(model, pieces[8], sim::at(-0.4, 0.3, 0) * sim::yaw(gnomon::degrees(-70)));
    sim::opening door{.name = "door 1", .rectangle = {}};
    door.rectangle.center = {1, 2, 1};
    door.rectangle.lengths = {0.9, 2, 0};
    model.openings.push_back(door);
    return model;
}

sim::pose any_pose(gnomon::random_stream& random) {
    const auto turn = [&] { return gnomon::degrees(random.uniform(-180, 180)); };
    return sim::at(random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)) *
           sim::yaw(turn()) * sim::pitch(turn()) * sim::roll(turn());
}

sim::true_scan seen_from(const sim::scene& world, const sim::pose& sensor) {
    return sim::simulate(world, sim::vertical{.mount = sensor}, sim::densities::medium());
}

/// The scan of a moved model is that of the model from a sensor that is moved inversely.
TEST(scene, holds_models_that_are_seen_as_they_are) {
    const sim::scene model = desk_corner();
    gnomon::random_stream random(7);
    for (int trial = 0; trial < 20; ++trial) {
        sim::scene world;
        world.add_object("stone", sim::box{0.1, 0.1, 0.1}, sim::at(0, 0, -50));
        const sim::pose place = any_pose(random);
        ASSERT_EQ(sim::add(world, model, place), 1);
        const sim::pose sensor = sim::at(-2.5, 0, 0.8);
        const auto expected = seen_from(model, sensor);
        const auto found = seen_from(world, place * sensor);
        // Rounding may decide whether a ray meets an edge.
        ASSERT_GT(expected.scan.size(), 100u);
        ASSERT_EQ(found.scan.size(), expected.scan.size());
        std::size_t others = 0;
        for (std::size_t i = 0; i < found.scan.size(); ++i) {
            if (found.surfaces[i] != expected.surfaces[i] + 6) {
                ++others;
                continue;
            }
            EXPECT_EQ(found.parts[i], expected.parts[i] + 1);
            EXPECT_EQ(found.objects[i], expected.objects[i] + 1);
            EXPECT_EQ(world.surface_name(found.surfaces[i]),
                      model.surface_name(expected.surfaces[i]));
            EXPECT_NEAR(found.ranges[i], expected.ranges[i], 1e-9);
            EXPECT_LT((found.normals[i] - place.direction_out(expected.normals[i])).norm(), 1e-9);
        }
        EXPECT_LE(others, 5u);
    }
}

TEST(scene, takes_all_of_a_model) {
    const sim::scene model = desk_corner();
    sim::scene world;
    world.sensor = sim::at(5, 6, 7);
    const sim::pose place = sim::at(1, 2, 3) * sim::yaw(gnomon::degrees(90));
    EXPECT_EQ(sim::add(world, model, place), 0);
    EXPECT_EQ(sim::add(world, model, place), 2);
    EXPECT_EQ(world.sensor.position, Eigen::Vector3d(5, 6, 7));
    EXPECT_EQ(world.objects(),
              (std::vector<std::string>{"stool", "round table", "stool", "round table"}));
    const auto parts = model.parts().size();
    const auto surfaces = model.surfaces().size();
    ASSERT_EQ(world.parts().size(), 2 * parts);
    ASSERT_EQ(world.surfaces().size(), 2 * surfaces);
    ASSERT_EQ(world.shapes().size(), 2 * model.shapes().size());
    for (std::size_t i = 0; i < 2 * surfaces; ++i) {
        EXPECT_EQ(world.surface_name(static_cast<std::int32_t>(i)),
                  model.surface_name(static_cast<std::int32_t>(i % surfaces)));
    }
    EXPECT_EQ(world.parts()[parts].object, 2);
    // Shapes are shared, and their bounds as tight as if they had been added here.
    for (std::size_t i = 0; i < model.shapes().size(); ++i) {
        EXPECT_EQ(world.shapes()[i].shape, model.shapes()[i].shape);
        const auto size = model.shapes()[i].shape->extent().size();
        EXPECT_LT(world.shapes()[i].extent.size().norm(), 1.5 * size.norm());
    }
    ASSERT_EQ(world.openings.size(), 2u);
    const auto& door = world.openings[1].rectangle;
    EXPECT_EQ(world.openings[1].name, "door 1");
    EXPECT_LT((door.center - Eigen::Vector3d(-1, 3, 4)).norm(), 1e-12);
    EXPECT_LT((door.axes.col(0) - Eigen::Vector3d(0, 1, 0)).norm(), 1e-12);
    EXPECT_LT((door.axes.col(2) - Eigen::Vector3d(0, 0, 1)).norm(), 1e-12);
    EXPECT_EQ(door.lengths, Eigen::Vector3d(0.9, 2, 0));
}

/// Added to an empty scene where it is, a scene stays what it was, to the last bit.
TEST(scene, copies_a_room) {
    const auto room = sim::scenes::furnished_room({.pieces = 5, .openings = true});
    sim::scene copy;
    EXPECT_EQ(sim::add(copy, room), 0);
    EXPECT_EQ(copy.openings.size(), room.openings.size());
    const auto expected = seen_from(room, room.sensor);
    const auto found = seen_from(copy, room.sensor);
    EXPECT_EQ(found.surfaces, expected.surfaces);
    EXPECT_EQ(found.objects, expected.objects);
    ASSERT_EQ(found.ranges.size(), expected.ranges.size());
    EXPECT_EQ(std::memcmp(found.ranges.data(), expected.ranges.data(),
                          expected.ranges.size() * sizeof(double)),
              0);
}

TEST(scene, can_be_added_to_itself) {
    sim::scene world = desk_corner();
    const auto shapes = world.shapes().size();
    EXPECT_EQ(sim::add(world, world, sim::at(10, 0, 0)), 2);
    EXPECT_EQ(sim::add(world, "all", world, sim::at(0, 10, 0)), 4);
    EXPECT_EQ(world.objects(),
              (std::vector<std::string>{"stool", "round table", "stool", "round table", "all"}));
    EXPECT_EQ(world.shapes().size(), 4 * shapes);
    EXPECT_EQ(world.openings.size(), 4u);
    EXPECT_EQ(world.parts().back().object, 4);
    EXPECT_EQ(world.surfaces().back().part, static_cast<std::int32_t>(world.parts().size()) - 1);
}

TEST(scene, takes_a_model_as_one_object) {
    const sim::scene model = desk_corner();
    sim::scene world;
    sim::add(world, model);
    const auto corner = sim::add(world, "corner", model, sim::at(4, 0, 0));
    EXPECT_EQ(corner, 2);
    EXPECT_EQ(world.objects().back(), "corner");
    ASSERT_EQ(world.parts().size(), 2 * model.parts().size());
    for (std::size_t i = 0; i < model.parts().size(); ++i) {
        const auto& part = world.parts()[model.parts().size() + i];
        EXPECT_EQ(part.object, corner);
        EXPECT_EQ(part.name, model.parts()[i].name);
    }
    EXPECT_NE(world.find_surface("corner/seat/mantle"), sim::nothing);
}

TEST(scene, takes_models_without_objects) {
    sim::scene world;
    EXPECT_EQ(sim::add(world, sim::scene{}), sim::nothing);
    EXPECT_TRUE(world.objects().empty());
    EXPECT_EQ(sim::add(world, "empty", sim::scene{}), 0);
    EXPECT_EQ(world.objects(), std::vector<std::string>{"empty"});
    EXPECT_TRUE(world.shapes().empty());
}

TEST(scene, stays_as_it_is_if_a_model_cannot_be_placed) {
    const sim::scene model = desk_corner();
    sim::scene world = desk_corner();
    sim::pose skewed;
    skewed.rotation(0, 1) = 0.5;
    sim::pose mirrored;
    mirrored.rotation(0, 0) = -1.0;
    for (const sim::pose& bad : {skewed, mirrored, sim::at(clouds::nan, 0, 0),
                                 sim::at(clouds::infinity, 0, 0), sim::at(6e149, 0, 0)}) {
        sim::scene far = model;
        sim::add(far, sim::scene(model), sim::at(6e149, 0, 0));
        EXPECT_THROW(sim::add(world, far, bad), std::invalid_argument);
        EXPECT_THROW(sim::add(world, "name", far, bad), std::invalid_argument);
    }
    EXPECT_EQ(world.objects(), model.objects());
    EXPECT_EQ(world.parts().size(), model.parts().size());
    EXPECT_EQ(world.surfaces().size(), model.surfaces().size());
    EXPECT_EQ(world.shapes().size(), model.shapes().size());
    EXPECT_EQ(world.openings.size(), 1u);
}

}  // namespace
