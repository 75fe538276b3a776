// SPDX-License-Identifier: BSL-1.0
#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/ray_caster_laws.hpp"
#include "simulation/meshes.hpp"
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

sim::scene balls(std::size_t n) {
    sim::scene world;
    const auto part = world.add_part(world.add_object("balls"), "all");
    gnomon::random_stream random(n);
    for (std::size_t i = 0; i < n; ++i) {
        world.add(part, sim::sphere{random.uniform(0.0, 0.4)},
                  sim::at(random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9)));
    }
    return world;
}

TEST(bvh_caster, obeys_the_law) {
    for (const auto& [name, world] :
         {std::pair{"kitchen", sim::scenes::kitchen()},
          std::pair{"living room", sim::scenes::living_room()},
          std::pair{"furnished room", sim::scenes::furnished_room({.pieces = 15, .seed = 3})},
          std::pair{"one ball", balls(1)}, std::pair{"many balls", balls(500)}}) {
        SCOPED_TRACE(name);
        EXPECT_GT(laws::obeys_ray_caster_laws(world, sim::bvh_caster(world), 1), 100u);
    }
}

/// A tree over triangles answers as a walk through all of them.
TEST(bvh_caster, obeys_the_law_for_meshes) {
    sim::scene world;
    const auto part = world.add_part(world.add_object("bins"), "all");
    sim::scene apart;  // the same, a shape per triangle
    const auto apart_part = apart.add_part(apart.add_object("bins"), "all");
    for (int i = 0; i < 5; ++i) {
        const auto mesh = meshes::of_cylinder({0.4, 1.0}, 40);
        const auto place = sim::at(i, 0.3 * i, 0.1 * i) * sim::roll(gnomon::degrees(20.0 * i));
        world.add(part, mesh, place);
        for (const sim::triangle& t : mesh.triangles().triangles) {
            apart.add(apart_part, sim::triangle_mesh({mesh.triangles().vertices, {t}, {}}), place);
        }
    }
    const sim::bvh_caster caster(world);
    gnomon::random_stream random(3);
    const auto extent = world.extent();
    std::size_t hits = 0;
    for (int i = 0; i < 3000; ++i) {
        const auto r = laws::ray_within(extent, random);
        const auto expected = laws::by_asking_all(apart, r);
        const auto found = caster(r);
        ASSERT_EQ(expected.has_value(), found.has_value());
        if (!expected) continue;
        EXPECT_EQ(found->range, expected->range);
        ++hits;
    }
    EXPECT_GT(hits, 500u);
}

TEST(bvh_caster, sees_nothing_in_an_empty_scene) {
    EXPECT_FALSE(sim::bvh_caster(sim::scene())({{0, 0, 0}, {1, 0, 0}}));
}

TEST(bvh_caster, survives_rays_that_are_none) {
    const auto world = sim::scenes::kitchen();
    const sim::bvh_caster caster(world);
    for (const sim::ray& r :
         {sim::ray{{1, 0, 1}, {0, 0, 0}}, sim::ray{{1, 0, 1}, {clouds::nan, 0, 0}},
          sim::ray{{clouds::nan, 0, 0}, {1, 0, 0}}, sim::ray{{1, 0, 1}, {1, 0, 0}, clouds::nan},
          sim::ray{{clouds::infinity, 0, 0}, {-1, 0, 0}}}) {
        EXPECT_FALSE(caster(r));
    }
}

/// Hundreds of shapes at one place make a deep tree of nothing to choose from.
TEST(bvh_caster, survives_coincident_shapes) {
    sim::scene world;
    const auto part = world.add_part(world.add_object("same"), "all");
    for (int i = 0; i < 5000; ++i) world.add(part, sim::box{1, 1, 1}, sim::at(3, 0, 0));
    for (int i = 0; i < 2000; ++i)  // each center half as far from the last as the one before
        world.add(part, sim::box{1e-9, 1e-9, 1e-9}, sim::at(std::ldexp(1.0, -i % 900), 9, 9));
    const auto hit = sim::bvh_caster(world)({{0, 0, 0}, {1, 0, 0}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->range, 2.5);
}

}  // namespace
