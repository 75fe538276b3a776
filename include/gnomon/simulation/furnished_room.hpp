// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random furnished rooms, one for each seed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/detail/openings.hpp>
#include <gnomon/simulation/detail/room.hpp>
#include <gnomon/simulation/detail/room_layout.hpp>
#include <gnomon/simulation/detail/room_pieces.hpp>
#include <gnomon/simulation/detail/upright_box.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

namespace detail {

/// The radius of a circle about the origin that holds a piece of furniture, seen from above [m].
[[nodiscard]] inline double radius_of(const furniture_model& model) {
    scene alone;
    add(alone, model);
    double radius = 0.0;
    for (const placed_shape& s : alone.shapes()) {
        const auto& [low, high] = s.extent;
        radius = std::max(radius,
                          std::hypot(std::max(-low.x(), high.x()), std::max(-low.y(), high.y())));
    }
    return radius;
}

/// Circles on the floor of a room that do not overlap each other or the walls.
struct circles_on_floor {
    struct circle {
        double x, y, radius;  ///< [m]
    };
    bounds room;
    std::vector<circle> taken;

    /// The place of a piece in a new circle, at any angle; nothing if no place is found.
    [[nodiscard]] std::optional<floor_place> place(double radius, random_stream& random) {
        const auto& [low, high] = room;
        if (2.0 * radius > std::min(high.x() - low.x(), high.y() - low.y())) return std::nullopt;
        for (int trial = 0; trial < 100; ++trial) {
            const circle found{random.uniform(low.x() + radius, high.x() - radius),
                               random.uniform(low.y() + radius, high.y() - radius), radius};
            const bool is_free = std::all_of(taken.begin(), taken.end(), [&](const circle& c) {
                return std::hypot(found.x - c.x, found.y - c.y) >= found.radius + c.radius;
            });
            const angle turned = degrees(random.uniform(-180.0, 180.0));
            if (!is_free) continue;
            taken.push_back(found);
            return floor_place{found.x, found.y, turned};
        }
        return std::nullopt;
    }
};

}  // namespace detail

namespace scenes {

/// Options of furnished_room().
struct room_options {
    int pieces = 8;  ///< of furniture; fewer if they do not fit
    std::uint64_t seed = 1;
    bool openings = false;  ///< doors and windows in the walls; the furniture is the same
    int clutter = 0;        ///< other things, clutter_models(); fewer if they do not fit
    bool touching = false;  ///< furniture and clutter touch walls and each other
    std::vector<furniture_model> models = {};  ///< to choose from; furniture_models() if empty
};

/// A room of 4 to 6 by 4 to 6 by 2.4 to 3 m with a cupboard and pieces of furniture, placed without
/// overlap at random positions and angles. The sensor is at a wall, 1.0 to 1.6 m above the floor.
///
/// With openings the walls, 12 to 36 cm thick, have one or two doors and one to three windows with
/// reveals, listed in `scene::openings`. Behind a door is its leaf or a corridor, behind a window
/// another house or nothing.
///
/// Clutter has names such as "carton 3", and stands in front of the sensor: at the walls what
/// belongs there, half of all within half a metre of a piece of furniture, and the rest anywhere,
/// without overlap; the furniture is the same. If objects are to touch, each piece of furniture is
/// instead placed where it touches a wall or another piece, by less than 4 mm, chairs facing it: a
/// seat may be below a table; and so is a quarter of the clutter.
/// @throws std::invalid_argument  unless 0 to 1,000 pieces of each are wanted
[[nodiscard]] inline scene furnished_room(const room_options& options = {}) {
    for (const int count : {options.pieces, options.clutter})
        gnomon::detail::require(count >= 0 && count <= 1000,
                                "furnished_room: requires 0 to 1,000 pieces");
    random_stream random(options.seed);
    const double length = random.uniform(4.0, 6.0);
    const double width = random.uniform(4.0, 6.0);
    scene world;
    world.sensor = at(0.3, 0.0, random.uniform(1.0, 1.6)) * pitch(degrees(10));
    const double height = random.uniform(2.4, 3.0);
    const bounds room{{0.0, -0.5 * width, 0.0}, {length, 0.5 * width, height}};
    const double side = random.uniform() < 0.5 ? -0.5 * width : 0.5 * width - 0.9;
    const bounds cupboard{{length - 0.55, side, 0.0},
                          {length, side + 0.9, random.uniform(1.2, 2.1)}};
    detail::room_openings openings;
    if (options.openings)
        openings = detail::room_openings(room, cupboard, random_stream(options.seed, 1));
    detail::add_room(world, room, openings.holes());
    detail::add_block(world, "cupboard", cupboard);

    detail::room_layout layout(room, world.sensor.position);
    layout.take({detail::upright_box(cupboard, {})});
    std::vector<detail::standing_piece> furniture;
    const auto models = options.models.empty() ? furniture_models() : options.models;
    detail::circles_on_floor circles{room, {{0.3, 0.0, 0.7}, {length - 0.25, side + 0.45, 0.6}}};
    random_stream contacts(options.seed, 3);
    for (int piece = 0; piece < options.pieces; ++piece) {
        furniture_model model = models[random.below(models.size())];
        const auto own = detail::boxes_of(model, options.touching);
        const auto place = options.touching
                               ? detail::touching_place(layout, furniture, model, own, contacts)
                               : circles.place(detail::radius_of(model), random);
        if (!place) continue;
        furniture.emplace_back(own, *place);
        layout.take(furniture.back().boxes);
        model.name = detail::numbered(model.name, piece + 1);
        add(world, model, place->pose());
    }
    if (options.clutter > 0)
        detail::add_clutter(
            world, layout, furniture,
            clutter_models(static_cast<std::size_t>(options.clutter), ~options.seed),
            options.touching, random_stream(options.seed, 2));
    detail::add_openings(world, room, openings);
    return world;
}

}  // namespace scenes
}  // namespace gnomon::simulation
