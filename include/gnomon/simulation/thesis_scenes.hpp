// SPDX-License-Identifier: BSL-1.0
/// @file
/// The scenes of the thesis's experiments, and surrogates for those that it does not specify. In
/// metres, x forward, y left, z up; each scene includes its sensor pose. The dimensions that the
/// thesis does not give were chosen once.
///
/// Klasing 2010: Figs. 3.3, 3.4, 3.9, 4.8 and 4.11.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/detail/room.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/surface_of_revolution.hpp>

namespace gnomon::simulation::scenes {

/// Fig. 3.3: a box and a cylinder without a floor, scaled about their positions on it.
[[nodiscard]] inline scene box_and_cylinder(double scale = 1.0) {
    scene world;
    world.sensor = at(0.0, 0.0, 0.8);
    const double edge = 0.60 * scale;
    world.add_object("box", box{edge, edge, edge}, at(2.2, -0.55, 0.5 * edge) * yaw(degrees(30)));
    world.add_object("cylinder", cylinder{0.30 * scale, 0.90 * scale}, at(2.4, 0.55, 0.0));
    return world;
}

/// A surrogate of Fig. 3.4: two boxes and a bin below an LMS-400 that is pitched down. A horizontal
/// scan of 70 degrees in 0.455 s has about 7,346 points, as in the figure.
[[nodiscard]] inline scene boxes_and_bin() {
    scene world;
    world.sensor = at(0.0, 0.0, 1.0) * pitch(degrees(45));
    world.add_object("box 1", box{0.40, 0.30, 0.25}, at(0.9, 0.35, 0.125) * yaw(degrees(20)));
    world.add_object("box 2", box{0.30, 0.30, 0.40}, at(1.1, -0.30, 0.20) * yaw(degrees(-35)));
    world.add_object("bin", cylinder{0.15, 0.35}, at(1.2, 0.05, 0.0));
    return world;
}

/// Fig. 3.9: a plate of 30 x 30 cm at a uniformly distributed position in a volume of 2 x 2 x 1 m
/// in front of the sensor. Yaw and pitch are uniformly distributed; attitudes at which the ray to
/// the middle meets the plate at less than 5 degrees are rejected.
[[nodiscard]] inline scene plate(std::uint64_t seed) {
    random_stream random(seed);
    while (true) {
        pose place =
            at(random.uniform(0.5, 2.5), random.uniform(-1.0, 1.0), random.uniform(-0.5, 0.5));
        place = place * yaw(degrees(random.uniform(-180.0, 180.0))) *
                pitch(degrees(random.uniform(0.0, 180.0)));
        const Eigen::Vector3d normal = place.direction_out({0.0, 0.0, 1.0});
        const double cosine = normal.dot(place.position) / place.position.norm();
        if (std::abs(cosine) < sin(degrees(5))) continue;
        scene world;
        world.add_object("plate", plane_patch{0.30, 0.30}, place);
        return world;
    }
}

/// Fig. 4.8 (a): a table and four chairs, one of them with a lattice back, in front of a sink and a
/// cupboard.
/// @param scale  of all furniture, about its position on the floor
[[nodiscard]] inline scene kitchen(double scale = 1.0) {
    scene world;
    world.sensor = at(0.3, 0.0, 1.2) * pitch(degrees(10));
    detail::add_room(world, {{0.0, -2.2, 0.0}, {4.2, 2.2, 2.5}});
    // A block on the floor at the far wall, centered at y.
    const auto cabinet = [&](const char* name, double y, double depth, double width,
                             double height) {
        detail::add_block(world, name,
                          {{4.2 - scale * depth, y - 0.5 * scale * width, 0.0},
                           {4.2, y + 0.5 * scale * width, scale * height}});
    };
    cabinet("cupboard", 1.7, 0.6, 0.8, 2.1);
    cabinet("sink cabinet", -0.7, 0.6, 1.8, 0.9);

    const table dining = scaled(table{.length = 0.8, .width = 1.2, .height = 0.74}, scale);
    const chair plain = scaled(chair{}, scale);
    chair lattice = plain;
    lattice.back = chair_back::lattice;
    add(world, "table", dining, at(2.2, -0.2, 0.0));
    add(world, "chair 1", plain, at(1.55, -0.50, 0.0));
    add(world, "chair 2", lattice, at(1.55, 0.25, 0.0));
    add(world, "chair 3", plain, at(2.85, -0.50, 0.0) * yaw(degrees(180)));
    add(world, "chair 4", plain, at(2.20, 0.75, 0.0) * yaw(degrees(-90)));
    return world;
}

/// Fig. 4.8 (b): two armchairs, a table, a sideboard and a vase on a platform of three steps. The
/// vase is not occluded by an armchair.
[[nodiscard]] inline scene living_room() {
    scene world;
    world.sensor = at(0.3, 0.0, 1.3) * pitch(degrees(10));
    detail::add_room(world, {{0.0, -2.5, 0.0}, {5.0, 2.5, 2.5}});
    detail::add_block(world, "step 1", {{1.75, -2.5, 0.0}, {2.00, 2.5, 0.15}});
    detail::add_block(world, "step 2", {{2.00, -2.5, 0.0}, {2.25, 2.5, 0.30}});
    detail::add_block(world, "platform", {{2.25, -2.5, 0.0}, {5.00, 2.5, 0.45}});

    const chair armchair = detail::armchair(0.42);
    const pose platform = at(0.0, 0.0, 0.45);
    add(world, "armchair 1", armchair, platform * at(3.1, 1.1, 0.0) * yaw(degrees(-90)));
    add(world, "armchair 2", armchair, platform * at(3.1, -1.1, 0.0) * yaw(degrees(90)));
    add(world, "small table",
        table{.length = 0.60, .width = 0.60, .height = 0.45, .thickness = 0.04, .inset = 0.0},
        platform * at(3.3, 0.0, 0.0));
    detail::add_block(world, "sideboard", {{4.6, -0.8, 0.45}, {5.0, 0.8, 1.25}});
    world.add_object(
        "vase",
        surface_of_revolution(
            {{0.10, 0.00}, {0.18, 0.15}, {0.20, 0.35}, {0.09, 0.50}, {0.07, 0.60}, {0.11, 0.68}}),
        platform * at(2.9, 2.0, 0.0));
    return world;
}

}  // namespace gnomon::simulation::scenes

namespace gnomon::simulation::detail {

/// The room of Fig. 4.11, with a column in front of its far wall. The sensor hangs from the
/// ceiling, as in the experiments.
[[nodiscard]] inline scene column_room() {
    scene world;
    world.sensor = at(0.4, 0.0, 1.6) * pitch(degrees(20));
    detail::add_room(world, {{-0.5, -2.0, 0.0}, {4.5, 2.0, 2.8}});
    detail::add_block(world, "column", {{3.6, -0.2, 0.0}, {3.9, 0.2, 2.8}});
    return world;
}

}  // namespace gnomon::simulation::detail

namespace gnomon::simulation::scenes {

/// A surrogate of Fig. 4.11 (a): two chairs in a room with a column.
[[nodiscard]] inline scene two_chairs() {
    scene world = detail::column_room();
    add(world, "chair 1", chair{}, at(2.3, 0.75, 0.0) * yaw(degrees(-160)));
    add(world, "chair 2", chair{.back = chair_back::ladder, .back_height = 0.98, .slats = 3},
        at(2.5, -0.70, 0.0) * yaw(degrees(130)));
    return world;
}

/// A surrogate of Fig. 4.11 (b), "Seat, Armchair, Table": the same room.
[[nodiscard]] inline scene seat_armchair_table() {
    scene world = detail::column_room();
    add(world, "seat",
        chair{.width = 0.50,
              .depth = 0.50,
              .seat_height = 0.44,
              .back = chair_back::none,
              .massive = true},
        at(1.9, 0.85, 0.0) * yaw(degrees(15)));
    add(world, "armchair", detail::armchair(0.42), at(2.9, -0.95, 0.0) * yaw(degrees(150)));
    add(world, "table", table{.length = 0.90, .width = 0.55, .height = 0.45, .inset = 0.0},
        at(2.4, 0.05, 0.0) * yaw(degrees(-10)));
    return world;
}

}  // namespace gnomon::simulation::scenes
