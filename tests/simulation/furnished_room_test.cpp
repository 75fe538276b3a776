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
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/detail/upright_box.hpp>
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

void expect_begins_with(const sim::scene& plain, const sim::scene& more) {
    ASSERT_LT(plain.objects().size(), more.objects().size());
    EXPECT_TRUE(std::equal(plain.objects().begin(), plain.objects().end(), more.objects().begin()));
    ASSERT_LT(plain.shapes().size(), more.shapes().size());
    EXPECT_EQ(plain.sensor.position, more.sensor.position);
    for (std::size_t i = 0; i < plain.shapes().size(); ++i) {
        const auto &a = plain.shapes()[i], &b = more.shapes()[i];
        EXPECT_EQ(a.extent.low, b.extent.low);
        EXPECT_EQ(a.extent.high, b.extent.high);
        EXPECT_EQ(a.pose.rotation, b.pose.rotation);
        EXPECT_EQ(a.first_surface, b.first_surface);
    }
}

TEST(furnished_room, with_openings_or_clutter_has_the_same_furniture) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const auto plain = furnished_room({.seed = seed});
        expect_begins_with(plain, furnished_room({.seed = seed, .openings = true}));
        expect_begins_with(plain, furnished_room({.seed = seed, .clutter = 10}));
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

/// A box about each shape of each object, without the room: number 0.
std::vector<std::vector<sim::detail::upright_box>> boxes_by_object(const sim::scene& world) {
    std::vector<std::vector<sim::detail::upright_box>> boxes(world.objects().size());
    for (const auto& s : world.shapes()) {
        const auto part = world.surfaces()[static_cast<std::size_t>(s.first_surface)].part;
        const auto object = world.parts()[static_cast<std::size_t>(part)].object;
        if (object == 0) continue;
        EXPECT_NEAR(s.pose.rotation(2, 2), 1.0, 1e-12);
        sim::bounds own = s.shape->extent();
        own.low.z() += s.pose.position.z();
        own.high.z() += s.pose.position.z();
        const auto heading = std::atan2(s.pose.rotation(1, 0), s.pose.rotation(0, 0));
        boxes[static_cast<std::size_t>(object)].emplace_back(
            own, sim::detail::floor_place{s.pose.position.x(), s.pose.position.y(),
                                          gnomon::radians(heading)});
    }
    return boxes;
}

/// The least distance of an object from some others.
double distance_from(const std::vector<std::vector<sim::detail::upright_box>>& boxes,
                     std::size_t object, std::size_t begin, std::size_t end) {
    double least = 10.0;
    for (std::size_t i = begin; i < end; ++i)
        if (i != object) least = std::min(least, distance(boxes[object], boxes[i]));
    return least;
}

double distance_from_walls(const std::vector<sim::detail::upright_box>& boxes,
                           const sim::bounds& floor) {
    double least = 10.0;
    for (const auto& b : boxes) {
        for (const Eigen::Vector2d& c : b.corners())
            for (int a = 0; a < 2; ++a)
                least = std::min({least, c[a] - floor.low[a], floor.high[a] - c[a]});
    }
    return least;
}

bool is_clutter(const std::string& name) {
    for (const auto& model : sim::clutter_models(8, 0))
        if (name.starts_with(model.name + " ")) return true;
    return false;
}

/// Nearly all clutter has a place within the room, in front of the sensor, and apart; half of it is
/// within half a metre of furniture.
TEST(furnished_room, has_clutter_between_its_pieces) {
    std::size_t pieces = 0, near_furniture = 0;
    constexpr std::uint64_t rooms = 10;
    for (std::uint64_t seed = 0; seed < rooms; ++seed) {
        const auto world = furnished_room({.pieces = 4, .seed = seed, .clutter = 22});
        const auto boxes = boxes_by_object(world);
        std::size_t first = 2;
        while (!is_clutter(world.objects()[first])) ++first;
        for (std::size_t i = first; i < boxes.size(); ++i) {
            EXPECT_TRUE(is_clutter(world.objects()[i])) << world.objects()[i];
            EXPECT_GE(distance_from(boxes, i, 1, boxes.size()), 0.05 - 1e-9);
            EXPECT_GE(distance_from_walls(boxes[i], world.shapes()[0].extent), 0.0);
            for (const auto& b : boxes[i])
                for (const auto& c : b.corners())
                    EXPECT_GE((c - world.sensor.position.head<2>()).norm(), 0.7 - 1e-9);
            near_furniture += distance_from(boxes, i, 2, first) <= 0.5;
        }
        pieces += boxes.size() - first;
    }
    EXPECT_GE(pieces, 20 * rooms);
    EXPECT_NEAR(static_cast<double>(near_furniture) / static_cast<double>(pieces), 0.5, 0.12);
    EXPECT_EQ(furnished_room({.clutter = 22}).objects(), furnished_room({.clutter = 22}).objects());
    EXPECT_THROW((void)furnished_room({.clutter = -1}), std::invalid_argument);
    EXPECT_LT(furnished_room({.clutter = 300}).objects().size(), 200u);
}

/// Each piece of furniture touches a wall, the cupboard or a piece that came before, and none is
/// within another.
TEST(furnished_room, may_have_furniture_that_touches) {
    std::size_t at_wall = 0, at_piece = 0;
    for (std::uint64_t seed = 0; seed < 15; ++seed) {
        const auto world = furnished_room({.seed = seed, .touching = true});
        const auto boxes = boxes_by_object(world);
        EXPECT_GE(boxes.size(), 6u);
        for (std::size_t i = 2; i < boxes.size(); ++i) {
            const double wall = distance_from_walls(boxes[i], world.shapes()[0].extent);
            const double other = distance_from(boxes, i, 1, i);
            EXPECT_GT(wall, 0.0);
            EXPECT_GT(other, 0.0);
            EXPECT_LT(std::min(wall, other), 0.004) << world.objects()[i];
            at_wall += wall < 0.004;
            at_piece += other < 0.004;
        }
    }
    EXPECT_GT(at_wall, 20u);
    EXPECT_GT(at_piece, 20u);
    EXPECT_EQ(furnished_room({.touching = true}).shapes().back().pose.position,
              furnished_room({.touching = true}).shapes().back().pose.position);
}

/// Of the clutter among touching furniture, some touches furniture, and none is within it.
TEST(furnished_room, may_have_clutter_that_touches) {
    std::size_t touching = 0;
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
        const auto world =
            furnished_room({.pieces = 4, .seed = seed, .clutter = 22, .touching = true});
        const auto boxes = boxes_by_object(world);
        for (std::size_t i = 2; i < boxes.size(); ++i) {
            const double nearest = distance_from(boxes, i, 1, boxes.size());
            EXPECT_GT(nearest, 0.0);
            touching += is_clutter(world.objects()[i]) && nearest < 0.004;
        }
    }
    EXPECT_GE(touching, 2u * 8u);
}

}  // namespace
