// SPDX-License-Identifier: BSL-1.0
/// @file
/// Walls and axis-aligned blocks of rooms.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/box.hpp>
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

/// Adds floor, ceiling and four walls as the parts of one object, "room".
inline void add_room(scene& world, const bounds& b) {
    const std::int32_t room = world.add_object("room");
    const auto add = [&](const char* name, double length, double width, const pose& place) {
        world.add(world.add_part(room, name), plane_patch{length, width}, place);
    };
    const double length = b.size().x();
    const double width = b.size().y();
    const double height = b.size().z();
    const Eigen::Vector3d m = b.middle();
    const pose middle = at(m.x(), m.y(), m.z());
    const pose facing_y = roll(degrees(90));
    const pose facing_x = yaw(degrees(90)) * facing_y;
    add("floor", length, width, middle * at(0.0, 0.0, -0.5 * height));
    add("ceiling", length, width, middle * at(0.0, 0.0, 0.5 * height));
    add("wall -y", length, height, middle * at(0.0, -0.5 * width, 0.0) * facing_y);
    add("wall +y", length, height, middle * at(0.0, 0.5 * width, 0.0) * facing_y);
    add("wall -x", width, height, middle * at(-0.5 * length, 0.0, 0.0) * facing_x);
    add("wall +x", width, height, middle * at(0.5 * length, 0.0, 0.0) * facing_x);
}

}  // namespace gnomon::simulation::detail
