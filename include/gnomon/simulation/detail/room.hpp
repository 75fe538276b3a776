// SPDX-License-Identifier: BSL-1.0
/// @file
/// Walls and axis-aligned blocks of rooms.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/detail/wall.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// Adds an axis-aligned block.
inline void add_block(scene& world, std::string name, const bounds& b) {
    const Eigen::Vector3d size = b.size();
    const Eigen::Vector3d m = b.middle();
    world.add_object(std::move(name), box{size.x(), size.y(), size.z()}, at(m.x(), m.y(), m.z()));
}

/// Where the patch of a wall is: a pose whose x is along the wall, y upwards.
struct wall_place {
    const char* name;
    pose frame;
    double length;    ///< [m]
    double height;    ///< [m]
    double outwards;  ///< 1 if z of the frame is away from the room, else -1
};

/// The four walls of a room.
[[nodiscard]] inline std::array<wall_place, 4> walls_of(const bounds& b) {
    const double length = b.size().x();
    const double width = b.size().y();
    const double height = b.size().z();
    const Eigen::Vector3d m = b.middle();
    const pose middle = at(m.x(), m.y(), m.z());
    const pose facing_y = roll(degrees(90));
    const pose facing_x = yaw(degrees(90)) * facing_y;
    return {{{"wall -y", middle * at(0.0, -0.5 * width, 0.0) * facing_y, length, height, 1.0},
             {"wall +y", middle * at(0.0, 0.5 * width, 0.0) * facing_y, length, height, -1.0},
             {"wall -x", middle * at(-0.5 * length, 0.0, 0.0) * facing_x, width, height, -1.0},
             {"wall +x", middle * at(0.5 * length, 0.0, 0.0) * facing_x, width, height, 1.0}}};
}

/// The holes of the four walls, in their order.
using wall_holes = std::array<std::vector<wall_rectangle>, 4>;

/// Adds floor, ceiling and four walls as the parts of one object, "room".
inline void add_room(scene& world, const bounds& b, const wall_holes& holes = {}) {
    const std::int32_t room = world.add_object("room");
    const Eigen::Vector3d size = b.size();
    const Eigen::Vector3d m = b.middle();
    const pose middle = at(m.x(), m.y(), m.z());
    const auto add_level = [&](const char* name, double height) {
        world.add(world.add_part(room, name), plane_patch{size.x(), size.y()},
                  middle * at(0.0, 0.0, height));
    };
    add_level("floor", -0.5 * size.z());
    add_level("ceiling", 0.5 * size.z());
    const auto places = walls_of(b);
    for (std::size_t i = 0; i < places.size(); ++i) {
        const plane_patch patch{places[i].length, places[i].height};
        const std::int32_t part = world.add_part(room, places[i].name);
        if (holes[i].empty())
            world.add(part, patch, places[i].frame);
        else
            world.add(part, wall{patch, holes[i]}, places[i].frame);
    }
}

}  // namespace gnomon::simulation::detail
