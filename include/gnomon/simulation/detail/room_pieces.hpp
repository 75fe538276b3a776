// SPDX-License-Identifier: BSL-1.0
/// @file
/// Pieces of a room, placed at random: furniture that touches walls and other furniture, and
/// clutter among the furniture.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/chair.hpp>
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/detail/room_layout.hpp>
#include <gnomon/simulation/detail/upright_box.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::detail {

/// A gap between pieces that touch [m]: none that a scan could show.
[[nodiscard]] inline double contact(random_stream& random) { return random.uniform(0.0005, 0.003); }

/// What must be free between pieces that touch: less than any contact().
inline constexpr double least_contact = 0.0004;  // [m]; numerical

/// A place for a piece where it touches a wall or a piece that is there: a chair with its back to
/// the wall or facing the other piece, and others with any side.
[[nodiscard]] inline std::optional<floor_place> touching_place(
    const room_layout& layout, const std::vector<standing_piece>& others,
    const furniture_model& model, const own_boxes& own, random_stream& random) {
    constexpr int trials = 300;
    constexpr double from_sensor = 0.7;  // [m]
    const bool is_chair = std::holds_alternative<chair>(model.piece);
    for (int trial = 0; trial < trials; ++trial) {
        const angle turned = degrees(is_chair ? 0.0 : 90.0 * static_cast<double>(random.below(4)));
        const bool is_at_piece = random.uniform() < 0.6;
        std::optional<floor_place> place;
        if (is_at_piece && !others.empty()) {
            const standing_piece& other = others[random.below(others.size())];
            const angle way = side_of(other, random);
            const angle heading =
                radians(way.radians() + degrees(180).radians() + turned.radians());
            place = beside(other, own, heading, way, random.uniform(-0.4, 0.4), contact(random));
        } else {
            place = layout.at_wall(own, turned, contact(random), random);
        }
        if (place && layout.is_free(placed(own, *place), least_contact, from_sensor)) return place;
    }
    return std::nullopt;
}

/// Puts clutter into a room: pieces that belong to walls there, and of the other ones a third 5 to
/// 40 cm from pieces of furniture, and the rest anywhere. If objects may touch, the third
/// touches furniture, and everything may come near.
inline void add_clutter(scene& world, room_layout layout,
                        const std::vector<standing_piece>& furniture,
                        const std::vector<furniture_model>& clutter, bool touching,
                        random_stream random) {
    constexpr int trials = 200;
    const double clearance = touching ? least_contact : 0.05;  // [m]
    std::map<std::string, int> numbers;
    std::size_t floor_pieces = 0;
    for (const furniture_model& model : clutter) {
        const own_boxes own = boxes_of(model, touching);
        double height = 0.0;
        for (const bounds& b : own) height = std::max(height, b.high.z());
        // High pieces would hide half of the room if they were near.
        const double from_sensor = height > 0.8 ? 1.5 : 0.7;
        const bool at_wall = belongs_to_wall(model);
        const std::size_t turn = at_wall ? 0 : ++floor_pieces;
        const bool at_furniture = turn % 3 == 1 && !furniture.empty();
        for (int trial = 0; trial < trials; ++trial) {
            std::optional<floor_place> place;
            if (at_wall) {
                place = layout.at_wall(own, degrees(0), random.uniform(0.01, 0.05), random);
            } else if (at_furniture) {
                const standing_piece& other = furniture[random.below(furniture.size())];
                const angle way =
                    touching ? side_of(other, random) : degrees(random.uniform(-180.0, 180.0));
                const angle heading = touching ? way : degrees(random.uniform(-180.0, 180.0));
                const double gap = touching ? contact(random) : random.uniform(0.05, 0.40);
                place = beside(other, own, heading, way, random.uniform(-0.4, 0.4), gap);
            } else {
                place = layout.anywhere(random);
            }
            if (!place) continue;
            const auto boxes = placed(own, *place);
            if (!layout.is_free(boxes, clearance, from_sensor)) continue;
            layout.take(boxes);
            furniture_model named = model;
            named.name = numbered(model.name, ++numbers[model.name]);
            add(world, named, place->pose());
            break;
        }
    }
}

}  // namespace gnomon::simulation::detail
