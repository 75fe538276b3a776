// SPDX-License-Identifier: BSL-1.0
/// @file
/// Chairs, given by their dimensions.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// The back of a chair.
enum class chair_back : char {
    none,     ///< a stool
    solid,    ///< a board
    lattice,  ///< upright slats between two rails
    ladder    ///< level slats between two posts
};

/// A chair. Its frame lies on the floor below the middle of the seat; it faces +x. Lengths in [m].
struct chair {
    double width = 0.42;                  ///< of the seat, along y; its diameter if round
    double depth = 0.42;                  ///< of the seat, along x, unless it is round
    double seat_height = 0.45;            ///< of its upper side
    double seat_thickness = 0.04;         ///< of the seat, unless it is massive
    double leg = 0.04;                    ///< edge length, or diameter if round
    chair_back back = chair_back::solid;  ///< what it is made of
    double back_height = 0.90;            ///< of its upper end
    double back_thickness = 0.03;         ///< of the back, along x
    int slats = 5;                        ///< of a lattice or ladder
    double slat_width = 0.03;             ///< of a lattice; of the posts of a ladder
    double rail_height = 0.04;            ///< of a lattice; of the slats of a ladder
    double arm_height = 0.0;              ///< of the upper side of the arms; 0 for none
    double arm_width = 0.05;              ///< of the arms, along y
    double arm_thickness = 0.03;          ///< of the arms, unless they are massive
    bool round = false;                   ///< seat and legs
    bool massive = false;                 ///< an armchair: no legs, seat and arms down to the floor
};

/// The chair with all lengths multiplied by `scale`.
[[nodiscard]] inline chair scaled(chair c, double scale) {
    for (double* measure : {&c.width, &c.depth, &c.seat_height, &c.seat_thickness, &c.leg,
                            &c.back_height, &c.back_thickness, &c.slat_width, &c.rail_height,
                            &c.arm_height, &c.arm_width, &c.arm_thickness}) {
        *measure *= scale;
    }
    return c;
}

namespace detail {

inline void add_back(object_builder& b, const chair& c) {
    const double x = 0.5 * (c.back_thickness - c.depth);
    const double low = c.seat_height;
    const double high = c.back_height;
    switch (c.back) {
        case chair_back::none:
            return;
        case chair_back::solid:
            b.part("back").block(x, 0.0, c.back_thickness, c.width, low, high);
            return;
        case chair_back::lattice: {
            b.part("back");
            b.block(x, 0.0, c.back_thickness, c.width, low, low + c.rail_height);
            b.block(x, 0.0, c.back_thickness, c.width, high - c.rail_height, high);
            const double step = (c.width - c.slat_width) / (c.slats > 1 ? c.slats - 1 : 1);
            for (int i = 0; i < c.slats; ++i) {
                const double y = 0.5 * (c.slat_width - c.width) + i * step;
                b.block(x, y, c.back_thickness, c.slat_width, low + c.rail_height,
                        high - c.rail_height);
            }
            return;
        }
        case chair_back::ladder: {
            b.part("back");
            const double y = 0.5 * (c.width - c.slat_width);
            b.block(x, -y, c.back_thickness, c.slat_width, low, high);
            b.block(x, y, c.back_thickness, c.slat_width, low, high);
            const double step = (high - low) / c.slats;
            for (int i = 1; i <= c.slats; ++i) {
                b.block(x, 0.0, c.back_thickness, c.width - 2.0 * c.slat_width,
                        low + i * step - c.rail_height, low + i * step);
            }
            return;
        }
    }
}

}  // namespace detail

/// Adds a chair with the parts "seat", "back", "leg 1" to "leg 4", "arm left" and "arm right", if
/// it has them. If a dimension is invalid, the scene keeps the parts that were added before.
/// @return the number of the object
/// @throws std::invalid_argument  if dimensions are negative, not finite, or inconsistent
inline std::int32_t add(scene& world, std::string name, const chair& c, const pose& at = {}) {
    detail::object_builder b(world, std::move(name), at);
    const double below = c.massive ? 0.0 : c.seat_height - c.seat_thickness;
    b.part("seat");
    if (c.round)
        b.disc(0.0, 0.0, c.width, below, c.seat_height);
    else
        b.block(0.0, 0.0, c.depth, c.width, below, c.seat_height);
    detail::add_back(b, c);
    if (!c.massive) {
        const double share = c.round ? detail::square_in_circle : 1.0;
        const double depth = c.round ? c.width : c.depth;
        detail::add_legs(b, 0.5 * (share * depth - c.leg), 0.5 * (share * c.width - c.leg), c.leg,
                         below, c.round);
    }
    if (c.arm_height > 0.0) {
        const double y = 0.5 * (c.width + c.arm_width);
        for (const auto& [part, side] : {std::pair{"arm right", -y}, std::pair{"arm left", y}}) {
            b.part(part);
            if (c.massive) {
                b.block(0.0, side, c.depth, c.arm_width, 0.0, c.arm_height);
            } else {
                const double rest = c.arm_height - c.arm_thickness;
                const double post = 0.5 * (c.depth - c.leg);
                b.block(0.0, side, c.depth, c.arm_width, rest, c.arm_height);
                b.block(-post, side, c.leg, c.leg, 0.0, rest);
                b.block(post, side, c.leg, c.leg, 0.0, rest);
            }
        }
    }
    return b.object();
}

}  // namespace gnomon::simulation
