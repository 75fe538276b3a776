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

namespace {

gnomon::scene balls(std::size_t n) {
    gnomon::scene world;
    const auto part = world.add_part(world.add_object("balls"), "all");
    gnomon::random_stream random(n);
    for (std::size_t i = 0; i < n; ++i) {
        world.add(part, gnomon::sphere{random.uniform(0.0, 0.4)},
                  gnomon::at(random.uniform(0, 9), random.uniform(0, 9), random.uniform(0, 9)));
    }
    return world;
}

TEST(bvh_caster, obeys_the_law) {
    for (const auto& [name, world] :
         {std::pair{"kitchen", gnomon::scenes::kitchen()},
          std::pair{"living room", gnomon::scenes::living_room()},
          std::pair{"furnished room", gnomon::scenes::furnished_room({.pieces = 15, .seed = 3})},
          std::pair{"one ball", balls(1)}, std::pair{"many balls", balls(500)}}) {
        SCOPED_TRACE(name);
        EXPECT_GT(laws::obeys_ray_caster_laws(world, gnomon::bvh_caster(world), 1), 100u);
    }
}

/// A tree over triangles answers as a walk through all of them.
TEST(bvh_caster, obeys_the_law_for_meshes) {
    gnomon::scene world;
    const auto part = world.add_part(world.add_object("bins"), "all");
    gnomon::scene apart;  // the same, a shape per triangle
    const auto apart_part = apart.add_part(apart.add_object("bins"), "all");
    for (int i = 0; i < 5; ++i) {
        const auto mesh = meshes::of_cylinder({0.4, 1.0}, 40);
        const auto place =
            gnomon::at(i, 0.3 * i, 0.1 * i) * gnomon::roll(gnomon::degrees(20.0 * i));
        world.add(part, mesh, place);
        for (const gnomon::triangle& t : mesh.triangles().triangles) {
            apart.add(apart_part, gnomon::triangle_mesh({mesh.triangles().vertices, {t}, {}}),
                      place);
        }
    }
    const gnomon::bvh_caster caster(world);
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
    EXPECT_FALSE(gnomon::bvh_caster(gnomon::scene())({{0, 0, 0}, {1, 0, 0}}));
}

TEST(bvh_caster, survives_rays_that_are_none) {
    const auto world = gnomon::scenes::kitchen();
    const gnomon::bvh_caster caster(world);
    for (const gnomon::ray& r :
         {gnomon::ray{{1, 0, 1}, {0, 0, 0}}, gnomon::ray{{1, 0, 1}, {clouds::nan, 0, 0}},
          gnomon::ray{{clouds::nan, 0, 0}, {1, 0, 0}},
          gnomon::ray{{1, 0, 1}, {1, 0, 0}, clouds::nan},
          gnomon::ray{{clouds::infinity, 0, 0}, {-1, 0, 0}}}) {
        EXPECT_FALSE(caster(r));
    }
}

/// Hundreds of shapes at one place make a deep tree of nothing to choose from.
TEST(bvh_caster, survives_coincident_shapes) {
    gnomon::scene world;
    const auto part = world.add_part(world.add_object("same"), "all");
    for (int i = 0; i < 5000; ++i) world.add(part, gnomon::box{1, 1, 1}, gnomon::at(3, 0, 0));
    for (int i = 0; i < 2000; ++i)  // each center half as far from the last as the one before
        world.add(part, gnomon::box{1e-9, 1e-9, 1e-9}, gnomon::at(std::ldexp(1.0, -i % 900), 9, 9));
    const auto hit = gnomon::bvh_caster(world)({{0, 0, 0}, {1, 0, 0}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->range, 2.5);
}

}  // namespace
