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

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::ray_caster<sim::embree_caster>);

/// Whether a ray passes within 1e-5 of an edge: some ray turned by that much, or less, to one of
/// eight sides meets another surface, or none, or one much nearer or farther.
bool is_near_an_edge(const sim::bvh_caster& caster, const sim::ray& r) {
    const auto hit = caster(r);
    const Eigen::Vector3d a = r.direction.unitOrthogonal();
    const Eigen::Vector3d b = r.direction.cross(a);
    for (const double width : {1e-5, 3e-6, 1e-6}) {
        for (int k = 0; k < 8; ++k) {
            const double angle = 0.785398 * k;
            sim::ray turned = r;
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
         {std::pair{"kitchen", sim::scenes::kitchen()},
          {"living room", sim::scenes::living_room()},
          {"furnished room", sim::scenes::furnished_room({.pieces = 15, .seed = 3})}}) {
        const sim::bvh_caster exact(world);
        const sim::embree_caster embree(world);
        const sim::rotational trajectory{.mount = world.sensor};
        const sim::scanner finder;
        std::size_t rays = 0;
        std::size_t near_edges = 0;
        double worst = 0.0;
        for (std::size_t line = 0; line < 160; ++line) {
            const sim::pose sensor = trajectory(static_cast<double>(line) / 40.0);
            for (std::size_t j = 0; j < finder.beams(); ++j) {
                const sim::ray r{sensor.position, sensor.direction_out(finder.direction(j))};
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

/// `simulate` takes either caster; the scans differ by rounding only.
TEST(embree_caster, scans) {
    const auto world = sim::scenes::kitchen();
    const sim::rotational around{.mount = world.sensor};
    const auto ours = sim::simulate(world, around, sim::densities::low(), {.sigma = 0.01});
    const auto theirs = sim::simulate(world, sim::embree_caster(world), around,
                                      sim::densities::low(), {.sigma = 0.01}, gnomon::threads{2});
    ASSERT_EQ(ours.scan.size(), theirs.scan.size());
    std::size_t close = 0;
    for (std::size_t i = 0; i < ours.scan.size(); ++i)
        close += (ours.scan.points[i] - theirs.scan.points[i]).norm() < 1e-4;
    EXPECT_GT(close, ours.scan.size() * 999 / 1000);
}

TEST(embree_caster, keeps_its_precision_far_from_the_origin) {
    sim::scene world;
    const Eigen::Vector3d utm(6e5, 4.8e6, 100);
    world.add_object("box", sim::box{1, 1, 1}, sim::at(utm.x() + 3, utm.y(), utm.z()));
    world.add_object("ball", sim::sphere{0.5}, sim::at(utm.x(), utm.y() + 3, utm.z()));
    const sim::embree_caster caster(world);
    EXPECT_NEAR(caster({utm, {1, 0, 0}})->range, 2.5, 1e-6);
    EXPECT_NEAR(caster({utm, {0, 1, 0}})->range, 2.5, 1e-6);
    EXPECT_EQ(caster({utm, {0, 1, 0}})->surface, 6);
}

/// A reach that ends just behind the hit does not hide it, and no hit lies beyond the reach.
TEST(embree_caster, keeps_to_the_reach) {
    const auto world = sim::scenes::living_room();
    const sim::bvh_caster exact(world);
    const sim::embree_caster embree(world);
    gnomon::random_stream random(1);
    const auto extent = world.extent();
    std::size_t rays = 0;
    std::size_t lost = 0;
    for (int i = 0; i < 20'000; ++i) {
        sim::ray r = laws::ray_within(extent, random);
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
    EXPECT_FALSE(sim::embree_caster(sim::scene())({{0, 0, 0}, {1, 0, 0}}));
    const sim::embree_caster caster(sim::scenes::kitchen());
    for (const sim::ray& r :
         {sim::ray{{1, 0, 1}, {0, 0, 0}}, sim::ray{{1, 0, 1}, {nan, 0, 0}},
          sim::ray{{nan, 0, 0}, {1, 0, 0}}, sim::ray{{1, 0, 1}, {1, 0, 0}, -1.0},
          sim::ray{{1, 0, 1}, {1, 0, 0}, nan}}) {
        EXPECT_FALSE(caster(r));
    }
}

}  // namespace
