// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/ray_caster_laws.hpp"
#include "simulation/meshes.hpp"
#include <gnomon/adapters/embree_caster.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/sphere.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace {

static_assert(gnomon::ray_caster<gnomon::embree_caster>);

/// Whether a ray passes within 1e-5 of an edge: some ray turned by that much, or less, to one of
/// eight sides meets another surface, or none, or one much nearer or farther.
bool is_near_an_edge(const gnomon::bvh_caster& caster, const gnomon::ray& r) {
    const auto hit = caster(r);
    const Eigen::Vector3d a = r.direction.unitOrthogonal();
    const Eigen::Vector3d b = r.direction.cross(a);
    for (const double width : {1e-5, 3e-6, 1e-6}) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.785398 * k;
            gnomon::ray turned = r;
            turned.direction =
                (r.direction + width * (std::cos(angle) * a + std::sin(angle) * b)).normalized();
            const auto other = caster(turned);
            if (hit.has_value() != other.has_value()) return true;
            if (hit && hit->surface != other->surface) return true;
        }
    }
    return false;
}

/// Embree computes in single precision: it names the same surface and range as the default caster,
/// but for rays near an edge, which are counted.
TEST(embree_caster, agrees_with_the_default_caster) {
    for (const auto& [name, world] :
         {std::pair{"kitchen", gnomon::scenes::kitchen()},
          {"living room", gnomon::scenes::living_room()},
          {"furnished room", gnomon::scenes::furnished_room({.pieces = 15, .seed = 3})}}) {
        const gnomon::bvh_caster exact(world);
        const gnomon::embree_caster embree(world);
        const gnomon::rotational trajectory{.mount = world.sensor};
        const gnomon::scanner finder;
        std::size_t rays = 0;
        std::size_t near_edges = 0;
        double worst = 0.0;
        for (std::size_t line = 0; line < 160; ++line) {
            const gnomon::pose sensor = trajectory(static_cast<double>(line) / 40.0);
            for (std::size_t j = 0; j < finder.beams(); ++j) {
                const gnomon::ray r{sensor.position, sensor.direction_out(finder.direction(j))};
                const auto expected = exact(r);
                const auto found = embree(r);
                ++rays;
                const bool same = expected && found && expected->surface == found->surface;
                if (!same) {
                    EXPECT_TRUE(is_near_an_edge(exact, r)) << name;
                    ++near_edges;
                    continue;
                }
                worst = std::max(worst, std::abs(found->range - expected->range) / expected->range);
                EXPECT_GT(found->normal.dot(expected->normal), 1 - 1e-5);
            }
        }
        EXPECT_LE(worst, 1e-5) << name;
        EXPECT_LT(near_edges, rays / 1000) << name;
        std::printf("%s: %zu rays, %zu near an edge, largest difference of ranges %.1e\n", name,
                    rays, near_edges, worst);
    }
}

/// The same scans but for the last digits, through the same door.
TEST(embree_caster, scans) {
    const auto world = gnomon::scenes::kitchen();
    const gnomon::rotational around{.mount = world.sensor};
    const auto ours = gnomon::simulate(world, around, gnomon::densities::low(), {.sigma = 0.01});
    const auto theirs =
        gnomon::simulate(world, gnomon::embree_caster(world), around, gnomon::densities::low(),
                         {.sigma = 0.01}, gnomon::threads{2});
    ASSERT_EQ(ours.scan.size(), theirs.scan.size());
    std::size_t close = 0;
    for (std::size_t i = 0; i < ours.scan.size(); ++i)
        close += (ours.scan.points[i] - theirs.scan.points[i]).norm() < 1e-4;
    EXPECT_GT(close, ours.scan.size() * 999 / 1000);
}

TEST(embree_caster, keeps_its_precision_far_from_the_origin) {
    gnomon::scene world;
    const Eigen::Vector3d utm(6e5, 4.8e6, 100);
    world.add_object("box", gnomon::box{1, 1, 1}, gnomon::at(utm.x() + 3, utm.y(), utm.z()));
    world.add_object("ball", gnomon::sphere{0.5}, gnomon::at(utm.x(), utm.y() + 3, utm.z()));
    const gnomon::embree_caster caster(world);
    EXPECT_NEAR(caster({utm, {1, 0, 0}})->range, 2.5, 1e-6);
    EXPECT_NEAR(caster({utm, {0, 1, 0}})->range, 2.5, 1e-6);
    EXPECT_EQ(caster({utm, {0, 1, 0}})->surface, 6);
}

/// A reach that ends just behind the hit does not hide it, and no hit lies beyond the reach.
TEST(embree_caster, keeps_to_the_reach) {
    const auto world = gnomon::scenes::living_room();
    const gnomon::bvh_caster exact(world);
    const gnomon::embree_caster embree(world);
    gnomon::random_stream random(1);
    const auto extent = world.extent();
    std::size_t rays = 0;
    std::size_t lost = 0;
    for (int i = 0; i < 20'000; ++i) {
        gnomon::ray r = laws::ray_within(extent, random);
        const auto hit = exact(r);
        if (!hit || hit->range < 0.1) continue;
        ++rays;
        r.reach = hit->range + (i % 2 ? 1e-9 : 0.0);
        const auto found = embree(r);
        lost += !found;
        if (found) {
            EXPECT_LE(found->range, r.reach);
        }
        r.reach = hit->range * (1.0 - 1e-4);
        const auto nearer = embree(r);
        if (nearer) {
            EXPECT_LE(nearer->range, r.reach);
        }
    }
    EXPECT_GT(rays, 10'000u);
    EXPECT_LE(lost, rays / 1000);  // at edges
    std::printf("%zu of %zu hits at the reach lost\n", lost, rays);
}

TEST(embree_caster, survives_bad_input) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(gnomon::embree_caster(gnomon::scene())({{0, 0, 0}, {1, 0, 0}}));
    const gnomon::embree_caster caster(gnomon::scenes::kitchen());
    for (const gnomon::ray& r :
         {gnomon::ray{{1, 0, 1}, {0, 0, 0}}, gnomon::ray{{1, 0, 1}, {nan, 0, 0}},
          gnomon::ray{{nan, 0, 0}, {1, 0, 0}}, gnomon::ray{{1, 0, 1}, {1, 0, 0}, -1.0},
          gnomon::ray{{1, 0, 1}, {1, 0, 0}, nan}}) {
        EXPECT_FALSE(caster(r));
    }
}

}  // namespace
