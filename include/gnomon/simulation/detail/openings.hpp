// SPDX-License-Identifier: BSL-1.0
/// @file
/// Doors and windows of a room, at random: holes of its walls with reveals, and the surfaces
/// behind.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/detail/room.hpp>
#include <gnomon/simulation/detail/wall.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// The surfaces behind a hole.
enum class behind_hole : char { nothing, leaf, corridor, house };

/// A door or a window.
struct room_opening {
    bool is_door = true;
    std::size_t wall = 0;
    wall_rectangle hole{};
    behind_hole behind = behind_hole::nothing;
    double distance = 0.0;  ///< of the surfaces behind it from the wall [m]
};

/// The openings of a room, from random numbers of their own. The sizes are those usual in houses.
struct room_openings {
    double thickness = 0.0;  ///< of all walls [m]
    std::vector<room_opening> all;

    room_openings() = default;

    /// One or two doors and one to three windows, fewer if they do not fit: two in one wall are at
    /// least 35 cm apart, and none is nearer than 25 cm to a corner or behind `piece`.
    /// @param piece  of furniture that touches walls
    room_openings(const bounds& room, const bounds& piece, random_stream random)
        : thickness(random.uniform(0.12, 0.36)) {
        const auto doors = 1 + random.below(2);
        const auto windows = 1 + random.below(3);
        const double height = room.size().z();
        for (std::uint64_t i = 0; i < doors; ++i) add(door(height, random), room, piece, random);
        for (std::uint64_t i = 0; i < windows; ++i)
            add(window(height, random), room, piece, random);
    }

    [[nodiscard]] wall_holes holes() const {
        wall_holes result;
        for (const room_opening& o : all) result[o.wall].push_back(o.hole);
        return result;
    }

  private:
    [[nodiscard]] room_opening door(double room_height, random_stream& random) const {
        room_opening o;
        o.hole = {0.0, random.uniform(0.75, 1.05), -0.5 * room_height,
                  random.uniform(1.95, 2.12) - 0.5 * room_height};
        if (random.uniform() < 0.4) {
            o.behind = behind_hole::leaf;
            o.distance = random.uniform(0.06, thickness);
        } else {
            o.behind = behind_hole::corridor;
            o.distance = thickness + random.uniform(1.1, 2.5);
        }
        return o;
    }

    [[nodiscard]] room_opening window(double room_height, random_stream& random) const {
        room_opening o;
        o.is_door = false;
        const double sill = random.uniform(0.6, 1.0);
        const double height = std::min(random.uniform(0.9, 1.5), room_height - 0.2 - sill);
        o.hole = {0.0, random.uniform(0.6, 1.8), sill - 0.5 * room_height,
                  sill + height - 0.5 * room_height};
        if (random.uniform() < 0.5) {
            o.behind = behind_hole::house;
            o.distance = thickness + random.uniform(4.0, 12.0);
        }
        return o;
    }

    /// Puts an opening into a wall where there is room for it, if that is found.
    void add(room_opening o, const bounds& room, const bounds& piece, random_stream& random) {
        const auto places = walls_of(room);
        const double width = o.hole.width();
        for (int trial = 0; trial < 50; ++trial) {
            o.wall = random.below(places.size());
            const double most = 0.5 * places[o.wall].length - 0.25;
            o.hole.left = random.uniform(-most, most - width);
            o.hole.right = o.hole.left + width;
            const bool is_free =
                std::none_of(all.begin(), all.end(), [&](const room_opening& other) {
                    return other.wall == o.wall && o.hole.is_near(other.hole, 0.35);
                });
            if (!is_free || is_behind(piece, o.hole, places[o.wall].frame)) continue;
            all.push_back(o);
            return;
        }
    }

    /// Whether furniture is nearer than 5 cm.
    [[nodiscard]] static bool is_behind(const bounds& piece, const wall_rectangle& hole,
                                        const pose& wall) {
        bounds around;
        for (const double side : {-0.05, 0.05}) {
            around.extend(wall.point_out({hole.left, hole.low, side}));
            around.extend(wall.point_out({hole.right, hole.high, side}));
        }
        for (int a = 0; a < 3; ++a) {
            if (around.low[a] > piece.high[a] || piece.low[a] > around.high[a]) return false;
        }
        return true;
    }
};

/// Adds the reveals of an opening, the surfaces behind it, and its entry in the list of openings.
inline void add_opening(scene& world, const room_opening& o, const wall_place& place,
                        double thickness, const std::string& name) {
    const wall_rectangle& hole = o.hole;
    const double x = 0.5 * (hole.left + hole.right), y = 0.5 * (hole.low + hole.high);
    const pose center = place.frame * at(x, y, 0.0);
    world.openings.push_back(
        {name, {center.position, center.rotation, {hole.width(), hole.height(), 0.0}}});

    const pose middle = center * at(0.0, 0.0, 0.5 * place.outwards * thickness);
    const std::int32_t object = world.add_object(name);
    const auto add = [&](const char* part, double length, double width, const pose& where) {
        world.add(world.add_part(object, part), plane_patch{length, width}, where);
    };
    const pose level = roll(degrees(90)), upright = pitch(degrees(90));
    add("sill", hole.width(), thickness, middle * at(0.0, -0.5 * hole.height(), 0.0) * level);
    add("lintel", hole.width(), thickness, middle * at(0.0, 0.5 * hole.height(), 0.0) * level);
    add("left", thickness, hole.height(), middle * at(-0.5 * hole.width(), 0.0, 0.0) * upright);
    add("right", thickness, hole.height(), middle * at(0.5 * hole.width(), 0.0, 0.0) * upright);
    const pose behind = center * at(0.0, 0.0, place.outwards * o.distance);
    if (o.behind == behind_hole::leaf) add("leaf", hole.width(), hole.height(), behind);
    if (o.behind == behind_hole::house) add("house", 16.0, 9.0, behind);
    if (o.behind != behind_hole::corridor) return;
    constexpr double length = 6.0;  // of the corridor [m]
    const double depth = o.distance - thickness;
    const pose floor =
        center * at(0.0, -0.5 * hole.height(), place.outwards * (thickness + 0.5 * depth)) * level;
    const double up = place.height;
    add("corridor", length, up, behind * at(0.0, 0.5 * (up - hole.height()), 0.0));
    add("corridor floor", length, depth, floor);
    add("corridor ceiling", length, depth,
        center * at(0.0, up - 0.5 * hole.height(), place.outwards * (thickness + 0.5 * depth)) *
            level);
}

/// Adds all openings, numbered by their kind.
inline void add_openings(scene& world, const bounds& room, const room_openings& openings) {
    int doors = 0, windows = 0;
    const auto places = walls_of(room);
    for (const room_opening& o : openings.all) {
        add_opening(world, o, places[o.wall], openings.thickness,
                    o.is_door ? numbered("door", ++doors) : numbered("window", ++windows));
    }
}

}  // namespace gnomon::simulation::detail
