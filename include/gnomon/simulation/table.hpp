// SPDX-License-Identifier: BSL-1.0
/// @file
/// Tables, given by their dimensions.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// The base of a table.
enum class table_base : char {
    legs,      ///< four
    panels,    ///< two, across its ends
    pedestal,  ///< a column on a foot
    trestles   ///< two pairs of legs, each with a beam across
};

/// A table. Its frame lies on the floor below the middle of the top. Lengths in [m].
struct table {
    double length = 1.20;                ///< of the top, along x; its diameter if round
    double width = 0.80;                 ///< of the top, along y, unless it is round
    double height = 0.74;                ///< of its upper side
    double thickness = 0.03;             ///< of the top
    double leg = 0.05;                   ///< edge length, or diameter if round
    double inset = 0.05;                 ///< of the legs from the edges of the top
    table_base base = table_base::legs;  ///< what carries it
    bool round = false;                  ///< top and legs
    double shelf_height = 0.0;      ///< of the upper side of a shelf between the legs; 0 for none
    double shelf_thickness = 0.02;  ///< of the shelf
    double foot_width = 0.55;       ///< diameter of the foot of a pedestal
    double foot_height = 0.03;      ///< of the foot of a pedestal
};

/// The table with all lengths multiplied by `scale`.
[[nodiscard]] inline table scaled(table t, double scale) {
    for (double* measure : {&t.length, &t.width, &t.height, &t.thickness, &t.leg, &t.inset,
                            &t.shelf_height, &t.shelf_thickness, &t.foot_width, &t.foot_height}) {
        *measure *= scale;
    }
    return t;
}

/// Adds a table with the parts "top", "leg 1" to "leg 4", "panel 1" and "panel 2", "column" and
/// "foot", "trestle 1" and "trestle 2", "shelf", if it has them. If a dimension is invalid, the
/// scene keeps the parts that were added before.
/// @return the number of the object
/// @throws std::invalid_argument  if dimensions are negative, not finite, or inconsistent
inline std::int32_t add(scene& world, std::string name, const table& t, const pose& at = {}) {
    detail::object_builder b(world, std::move(name), at);
    const double below = t.height - t.thickness;
    const double width = t.round ? t.length : t.width;
    const double share = t.round ? detail::square_in_circle : 1.0;
    const double x = 0.5 * (share * t.length - t.leg) - t.inset;
    const double y = 0.5 * (share * width - t.leg) - t.inset;
    b.part("top");
    if (t.round)
        b.disc(0.0, 0.0, t.length, below, t.height);
    else
        b.block(0.0, 0.0, t.length, t.width, below, t.height);
    switch (t.base) {
        case table_base::legs:
            detail::add_legs(b, x, y, t.leg, below, t.round);
            break;
        case table_base::panels:
            b.part("panel 1").block(-x, 0.0, t.leg, width - 2.0 * t.inset, 0.0, below);
            b.part("panel 2").block(x, 0.0, t.leg, width - 2.0 * t.inset, 0.0, below);
            break;
        case table_base::pedestal:
            b.part("column").disc(0.0, 0.0, t.leg, t.foot_height, below);
            b.part("foot").disc(0.0, 0.0, t.foot_width, 0.0, t.foot_height);
            break;
        case table_base::trestles: {
            int number = 0;
            for (const double side : {-x, x}) {
                b.part(detail::numbered("trestle", ++number));
                b.block(side, 0.0, t.leg, 2.0 * y + t.leg, below - t.leg, below);
                b.block(side, -y, t.leg, t.leg, 0.0, below - t.leg);
                b.block(side, y, t.leg, t.leg, 0.0, below - t.leg);
            }
            break;
        }
    }
    if (t.shelf_height > 0.0) {
        b.part("shelf").block(0.0, 0.0, 2.0 * x - t.leg, 2.0 * y - t.leg,
                              t.shelf_height - t.shelf_thickness, t.shelf_height);
    }
    return b.object();
}

}  // namespace gnomon::simulation
