// SPDX-License-Identifier: BSL-1.0
/// @file
/// Chairs and tables by their measures, and twelve of them to recognise: six chairs and six tables,
/// in the spirit of Klasing 2010, Fig. 5.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon {

/// What the back of a chair is made of.
enum class chair_back : char {
    none,     ///< a stool
    solid,    ///< a board
    lattice,  ///< upright slats between two rails
    ladder    ///< level slats between two posts
};

/// A chair. Its frame lies on the floor below the middle of the seat; it faces +x.
struct chair {
    double width = 0.42;        ///< of the seat, along y [m]
    double depth = 0.42;        ///< of the seat, along x [m]
    double seat_height = 0.45;  ///< of its upper side [m]
    double seat_thickness = 0.04;
    double leg = 0.04;  ///< edge length, or diameter if round [m]
    chair_back back = chair_back::solid;
    double back_height = 0.90;  ///< of its upper end [m]
    double back_thickness = 0.03;
    int slats = 5;
    double slat_width = 0.03;
    double rail_height = 0.04;
    double arm_height = 0.0;  ///< of the upper side of the arms [m]; 0 for none
    double arm_width = 0.05;
    bool round = false;    ///< seat and legs
    bool massive = false;  ///< an armchair: no legs, seat and arms down to the floor
};

/// What a table stands on.
enum class table_base : char {
    legs,      ///< four
    panels,    ///< two, across its ends
    pedestal,  ///< a column on a foot
    trestles   ///< two pairs of legs, each with a beam across
};

/// A table. Its frame lies on the floor below the middle of the top.
struct table {
    double length = 1.20;  ///< of the top, along x; its diameter if round [m]
    double width = 0.80;   ///< of the top, along y [m]
    double height = 0.74;  ///< of its upper side [m]
    double thickness = 0.03;
    double leg = 0.05;    ///< edge length, or diameter if round [m]
    double inset = 0.05;  ///< of the legs from the edges of the top [m]
    table_base base = table_base::legs;
    bool round = false;         ///< top and legs
    double shelf_height = 0.0;  ///< of the upper side of a shelf between the legs [m]; 0 for none
};

namespace detail {

/// "leg 3"
[[nodiscard]] inline std::string numbered(const char* name, int number) {
    std::string result(name);
    result += ' ';
    return result += std::to_string(number);
}

/// Adds the parts of one object, each of one shape or more.
class object_builder {
  public:
    object_builder(scene& world, std::string name, const pose& at)
        : world_(world), object_(world.add_object(std::move(name))), at_(at) {}

    /// Begins a part.
    object_builder& part(std::string name) {
        part_ = world_.add_part(object_, std::move(name));
        return *this;
    }

    /// An upright block of the part: its middle in x and y, and its lower and upper side [m].
    object_builder& block(double x, double y, double length, double width, double low,
                          double high) {
        world_.add(part_, box{length, width, high - low}, at_ * at(x, y, 0.5 * (low + high)));
        return *this;
    }

    /// An upright round block of the part.
    object_builder& disc(double x, double y, double diameter, double low, double high) {
        world_.add(part_, cylinder{0.5 * diameter, high - low}, at_ * at(x, y, low));
        return *this;
    }

    /// Square or round.
    object_builder& post(double x, double y, double thickness, double low, double high,
                         bool round) {
        return round ? disc(x, y, thickness, low, high)
                     : block(x, y, thickness, thickness, low, high);
    }

    [[nodiscard]] std::int32_t object() const { return object_; }

  private:
    scene& world_;
    std::int32_t object_;
    pose at_;
    std::int32_t part_ = nothing;
};

/// Four posts from the floor to `top`, in the corners of a rectangle of 2 x by 2 y.
inline void add_legs(object_builder& b, double x, double y, double thickness, double top,
                     bool round) {
    int number = 0;
    for (const double sx : {-x, x}) {
        for (const double sy : {-y, y}) {
            b.part(numbered("leg", ++number)).post(sx, sy, thickness, 0.0, top, round);
        }
    }
}

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

/// Adds a chair with the parts "seat", "back", "leg 1" to "leg 4", "arm left" and "arm right", as
/// far as it has them.
/// @return the number of the object
inline std::int32_t add(scene& world, std::string name, const chair& c, const pose& at) {
    detail::object_builder b(world, std::move(name), at);
    const double below = c.massive ? 0.0 : c.seat_height - c.seat_thickness;
    b.part("seat");
    if (c.round)
        b.disc(0.0, 0.0, c.width, below, c.seat_height);
    else
        b.block(0.0, 0.0, c.depth, c.width, below, c.seat_height);
    detail::add_back(b, c);
    if (!c.massive) {
        // The legs of a round seat stand in the square within it.
        const double share = c.round ? 0.7071 : 1.0;
        detail::add_legs(b, 0.5 * (share * c.depth - c.leg), 0.5 * (share * c.width - c.leg), c.leg,
                         below, c.round);
    }
    if (c.arm_height > 0.0) {
        const double y = 0.5 * (c.width + c.arm_width);
        for (const auto& [part, side] : {std::pair{"arm right", -y}, std::pair{"arm left", y}}) {
            b.part(part);
            if (c.massive) {
                b.block(0.0, side, c.depth, c.arm_width, 0.0, c.arm_height);
            } else {
                const double rest = c.arm_height - 0.03;
                const double post = 0.5 * (c.depth - c.leg);
                b.block(0.0, side, c.depth, c.arm_width, rest, c.arm_height);
                b.block(-post, side, c.leg, c.leg, 0.0, rest);
                b.block(post, side, c.leg, c.leg, 0.0, rest);
            }
        }
    }
    return b.object();
}

/// Adds a table with the parts "top", "leg 1" to "leg 4", "panel 1" and "panel 2", "column" and
/// "foot", "trestle 1" and "trestle 2", "shelf", as far as it has them.
/// @return the number of the object
inline std::int32_t add(scene& world, std::string name, const table& t, const pose& at) {
    detail::object_builder b(world, std::move(name), at);
    const double below = t.height - t.thickness;
    const double width = t.round ? t.length : t.width;
    const double share = t.round ? 0.7071 : 1.0;
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
            b.part("column").disc(0.0, 0.0, t.leg, 0.03, below);
            b.part("foot").disc(0.0, 0.0, 0.55 * width, 0.0, 0.03);
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
        b.part("shelf").block(0.0, 0.0, 2.0 * x - t.leg, 2.0 * y - t.leg, t.shelf_height - 0.02,
                              t.shelf_height);
    }
    return b.object();
}

/// A piece of furniture with the name of its kind.
struct furniture_model {
    std::string name;
    std::variant<chair, table> piece;
};

/// Adds a model as an object of its name.
/// @return the number of the object
inline std::int32_t add(scene& world, const furniture_model& model, const pose& at) {
    return std::visit([&](const auto& piece) { return add(world, model.name, piece, at); },
                      model.piece);
}

/// Six chairs, then six tables.
[[nodiscard]] inline std::vector<furniture_model> furniture_models() {
    return {
        {"kitchen chair", chair{}},
        {"lattice chair", chair{.back = chair_back::lattice}},
        {"ladder chair", chair{.width = 0.40,
                               .depth = 0.38,
                               .seat_height = 0.46,
                               .back = chair_back::ladder,
                               .back_height = 0.98,
                               .slats = 3}},
        {"stool",
         chair{
             .width = 0.36, .depth = 0.36, .leg = 0.035, .back = chair_back::none, .round = true}},
        {"carver", chair{.width = 0.48,
                         .depth = 0.46,
                         .seat_height = 0.44,
                         .back_height = 0.86,
                         .arm_height = 0.66}},
        {"armchair", chair{.width = 0.51,
                           .depth = 0.75,
                           .seat_height = 0.43,
                           .back_height = 0.85,
                           .back_thickness = 0.15,
                           .arm_height = 0.60,
                           .arm_width = 0.12,
                           .massive = true}},
        {"dining table", table{.length = 1.60, .width = 0.90}},
        {"coffee table", table{.length = 0.90,
                               .width = 0.55,
                               .height = 0.45,
                               .thickness = 0.05,
                               .inset = 0.0,
                               .shelf_height = 0.15}},
        {"round table",
         table{.length = 1.00, .leg = 0.10, .base = table_base::pedestal, .round = true}},
        {"desk", table{.length = 1.40,
                       .width = 0.70,
                       .height = 0.72,
                       .leg = 0.03,
                       .inset = 0.0,
                       .base = table_base::panels}},
        {"side table", table{.length = 0.55,
                             .width = 0.55,
                             .height = 0.50,
                             .leg = 0.04,
                             .inset = 0.0,
                             .round = false}},
        {"trestle table", table{.length = 1.80,
                                .width = 0.75,
                                .height = 0.75,
                                .inset = 0.20,
                                .base = table_base::trestles}},
    };
}

}  // namespace gnomon
