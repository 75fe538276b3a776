// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

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

/// Furniture of the user's own stands in the room by its name, in place of the built-in models.
TEST(furnished_room, takes_other_furniture) {
    sim::scene lamp;
    lamp.add_object("foot and shade", sim::box{0.3, 0.2, 1.5}, sim::at(0, 0, 0.75));
    const auto world = furnished_room({.pieces = 3, .models = {{"lamp", lamp}}});
    ASSERT_EQ(world.objects().size(), 5u);
    for (std::size_t i = 2; i < 5; ++i)
        EXPECT_EQ(world.objects()[i], "lamp " + std::to_string(i - 1));
    sim::scene hall;  // larger than any room
    hall.add_object("hall", sim::box{7, 7, 2}, sim::at(0, 0, 1));
    EXPECT_EQ(furnished_room({.models = {{"hall", hall}}}).objects().size(), 2u);
}

/// The hash (FNV-1a) of the points and surfaces of a scan.
std::uint64_t hash_of(const sim::scene& world) {
    const auto truth = sim::simulate(world, sim::rotational{.mount = world.sensor},
                                     sim::densities::low(), {.sigma = 0.015});
    std::uint64_t hash = 0xcbf29ce484222325u;
    const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3u; };
    for (const auto& p : truth.scan.points)
        for (int a = 0; a < 3; ++a) add(std::bit_cast<std::uint64_t>(p[a]));
    for (const auto s : truth.surfaces) add(static_cast<std::uint64_t>(s));
    return hash;
}

/// The value is that of the version before there were openings.
TEST(furnished_room, without_openings_is_what_it_was) {
    std::uint64_t hash = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto world = furnished_room({.seed = seed});
        EXPECT_TRUE(world.openings.empty());
        hash = 31 * hash + hash_of(world);
    }
    EXPECT_EQ(hash, 0xa5d854f4ef5367edu);
}

/// Whether a ray hits a surface of an object whose name begins with `name`.
bool hits(const sim::scene& world, const std::optional<sim::ray_hit>& hit, std::string_view name) {
    return hit && world.surface_name(hit->surface).starts_with(name);
}

TEST(furnished_room, with_openings_has_the_same_furniture) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto plain = furnished_room({.seed = seed});
        const auto open = furnished_room({.seed = seed, .openings = true});
        ASSERT_LT(plain.objects().size(), open.objects().size());
        EXPECT_TRUE(
            std::equal(plain.objects().begin(), plain.objects().end(), open.objects().begin()));
        ASSERT_LT(plain.shapes().size(), open.shapes().size());
        EXPECT_EQ(plain.sensor.position, open.sensor.position);
        for (std::size_t i = 0; i < plain.shapes().size(); ++i) {
            const auto &a = plain.shapes()[i], &b = open.shapes()[i];
            EXPECT_EQ(a.extent.low, b.extent.low);
            EXPECT_EQ(a.extent.high, b.extent.high);
            EXPECT_EQ(a.pose.rotation, b.pose.rotation);
            EXPECT_EQ(a.first_surface, b.first_surface);
        }
    }
}

/// Rays across the walls pass 1 mm inside the edges of each opening, and hit the wall 1 mm outside.
TEST(furnished_room, has_the_openings_that_it_lists) {
    std::size_t doors = 0, windows = 0, open = 0;
    for (std::uint64_t seed = 0; seed < 30; ++seed) {
        const auto world = furnished_room({.pieces = 0, .seed = seed, .openings = true});
        const sim::bvh_caster caster(world);
        const Eigen::Vector3d size = world.shapes()[0].extent.size();
        const Eigen::Vector3d middle(0.5 * size.x(), 0.0, 1.2);
        for (const auto& [name, rectangle] : world.openings) {
            const bool is_door = name.starts_with("door");
            (is_door ? doors : windows) += 1;
            EXPECT_GE(rectangle.lengths[0], 0.6);
            EXPECT_GE(rectangle.lengths[1], is_door ? 1.95 : 0.9);
            const double bottom = rectangle.center.z() - 0.5 * rectangle.lengths[1];
            EXPECT_NEAR(bottom, is_door ? 0.0 : 0.8, is_door ? 1e-9 : 0.2);
            const auto hit_at = [&](double x, double y) {
                const Eigen::Vector3d target =
                    rectangle.center + x * rectangle.axes.col(0) + y * rectangle.axes.col(1);
                const Eigen::Vector3d normal = rectangle.axes.col(2);
                const double side = normal.dot(middle - target) > 0.0 ? 1.0 : -1.0;
                return caster({target + 0.02 * side * normal, -side * normal});
            };
            for (const double side : {-1.0, 1.0}) {
                const double x = 0.5 * rectangle.lengths[0], y = 0.5 * rectangle.lengths[1];
                EXPECT_TRUE(hits(world, hit_at(side * (x + 1e-3), 0.0), "room/wall"));
                EXPECT_FALSE(hits(world, hit_at(side * (x - 1e-3), 0.0), "room/"));
                EXPECT_FALSE(hits(world, hit_at(0.0, side * (y - 1e-3)), "room/"));
                if (side > 0.0 || !is_door) {
                    EXPECT_TRUE(hits(world, hit_at(0.0, side * (y + 1e-3)), "room/wall"));
                }
            }
            open += hit_at(0.0, 0.0) ? 0 : 1;
        }
    }
    EXPECT_GT(doors, 30u);
    EXPECT_GT(windows, 30u);
    EXPECT_GT(open, 10u);
    EXPECT_LT(open, windows);
}

/// As triangles, walls have the same holes.
TEST(furnished_room, has_walls_of_triangles_with_the_same_holes) {
    const auto world = furnished_room({.pieces = 0, .seed = 3, .openings = true});
    for (std::size_t i = 0; i < 6; ++i) {
        const auto& wall = world.shapes()[i];
        const auto solid = wall.shape->triangles();
        ASSERT_TRUE(solid);
        const sim::triangle_mesh mesh(*solid, {"plane"});
        gnomon::random_stream random(i);
        int missed = 0;
        for (int k = 0; k < 2000; ++k) {
            const Eigen::Vector3d target(random.uniform(-3.0, 3.0), random.uniform(-1.5, 1.5), 0.0);
            const Eigen::Vector3d origin(0.3, -0.2, 2.0);
            const sim::ray r{origin, (target - origin).normalized()};
            const auto exact = wall.shape->first_hit(r), of_mesh = mesh.first_hit(r);
            EXPECT_EQ(exact.has_value(), of_mesh.has_value());
            missed += exact ? 0 : 1;
            EXPECT_NEAR(exact ? exact->range : 0.0, of_mesh ? of_mesh->range : 0.0, 1e-9);
        }
        EXPECT_LT(missed, 2000);
    }
}

}  // namespace
