// SPDX-License-Identifier: BSL-1.0
/// @file
/// Cars and vans, given by their dimensions: a body with a bonnet, a cabin with a slanted
/// windscreen and four wheels, with planar faces except for the wheels.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/detail/object_builder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// A car. Its frame lies on the road below the middle of the body; it faces +x. Lengths in [m].
struct vehicle {
    double length = 4.30;          ///< of the body, along x
    double width = 1.76;           ///< of the body, along y
    double height = 1.47;          ///< of the top above the road [m]
    double clearance = 0.22;       ///< height of the lower side of the body
    double belt_height = 0.92;     ///< of the upper side of the body, where the cabin begins
    double nose_height = 0.72;     ///< of the front end of the bonnet
    double bonnet = 1.05;          ///< length of the bonnet
    double boot = 0.45;            ///< length of the boot, behind the cabin
    double windscreen = 0.75;      ///< how far the top of the windscreen lies behind its bottom
    double rear_window = 0.40;     ///< how far the top of the rear window lies before its bottom
    double roof_inset = 0.14;      ///< by which the top is narrower than the body, on each side [m]
    double wheel_diameter = 0.63;  ///< [m]
    double wheel_width = 0.21;     ///< [m]
    double wheel_base = 2.60;      ///< distance between the axles
};

/// A delivery van.
[[nodiscard]] inline vehicle van() {
    return {.length = 5.20,
            .width = 1.96,
            .height = 2.15,
            .clearance = 0.26,
            .belt_height = 1.12,
            .nose_height = 0.92,
            .bonnet = 0.75,
            .boot = 0.02,
            .windscreen = 0.70,
            .rear_window = 0.08,
            .roof_inset = 0.10,
            .wheel_diameter = 0.68,
            .wheel_width = 0.22,
            .wheel_base = 3.20};
}

/// The vehicle with all lengths multiplied by `scale`.
[[nodiscard]] inline vehicle scaled(vehicle v, double scale) {
    for (double* measure : {&v.length, &v.width, &v.height, &v.clearance, &v.belt_height,
                            &v.nose_height, &v.bonnet, &v.boot, &v.windscreen, &v.rear_window,
                            &v.roof_inset, &v.wheel_diameter, &v.wheel_width, &v.wheel_base}) {
        *measure *= scale;
    }
    return v;
}

namespace detail {

/// @throws std::invalid_argument  unless the vehicle can be built
inline void require_valid(const vehicle& v) {
    using gnomon::detail::require;
    for (const double measure : {v.clearance, v.bonnet, v.boot, v.windscreen, v.rear_window,
                                 v.roof_inset, v.wheel_width}) {
        require(measure >= 0.0, "vehicle: dimensions must not be negative");
    }
    require(v.clearance < v.nose_height && v.nose_height <= v.belt_height &&
                v.belt_height < v.height && v.height < 100.0,
            "vehicle: needs clearance < nose height <= belt height < height, less than 100 m");
    require(v.bonnet + v.windscreen + v.rear_window + v.boot < v.length && v.length < 100.0,
            "vehicle: needs a roof between windscreen and rear window, and less than 100 m");
    require(2.0 * v.roof_inset < v.width && 2.0 * v.wheel_width < v.width && v.width < 100.0,
            "vehicle: roof and wheels must be narrower than the body, less than 100 m wide");
    require(
        v.wheel_diameter > 0.0 && v.wheel_base > 0.0 && v.wheel_base + v.wheel_diameter <= v.length,
        "vehicle: the wheels must lie between the ends of the body");
}

}  // namespace detail

/// Adds a vehicle with the parts "body" (surfaces "bottom", "front", "bonnet", "deck", "rear",
/// "left", "right"), "cabin" ("windscreen", "roof", "rear window", "floor", "left", "right") and
/// "wheel 1" to "wheel 4". The deck is the upper side of the body below the cabin and of the boot.
/// @return the number of the object
/// @throws std::invalid_argument  if dimensions are negative, not finite, or inconsistent; the
///                                scene is then left as it was
inline std::int32_t add(scene& world, std::string name, const vehicle& v, const pose& at = {}) {
    detail::require_valid(v);
    const double front = 0.5 * v.length;
    const double half = 0.5 * v.width;
    const double roof = half - v.roof_inset;
    const double cowl = front - v.bonnet;
    const double end = v.boot - front;
    const std::array<detail::profile_corner, 5> body{{{-front, v.clearance, half},
                                                      {front, v.clearance, half},
                                                      {front, v.nose_height, half},
                                                      {cowl, v.belt_height, half},
                                                      {-front, v.belt_height, half}}};
    const std::array<detail::profile_corner, 4> cabin{{{cowl, v.belt_height, half},
                                                       {cowl - v.windscreen, v.height, roof},
                                                       {end + v.rear_window, v.height, roof},
                                                       {end, v.belt_height, half}}};
    const std::int32_t object = world.add_object(std::move(name));
    world.add(
        world.add_part(object, "body"),
        detail::symmetric_solid(body, std::array{"bottom", "front", "bonnet", "deck", "rear"}), at);
    world.add(
        world.add_part(object, "cabin"),
        detail::symmetric_solid(cabin, std::array{"windscreen", "roof", "rear window", "floor"}),
        at);
    // The wheels stand out of the body by a tenth of their width.
    const double side = half - 0.9 * v.wheel_width;
    const double radius = 0.5 * v.wheel_diameter;
    int number = 0;
    for (const double x : {-0.5 * v.wheel_base, 0.5 * v.wheel_base}) {
        for (const double turn : {90.0, -90.0}) {
            pose axle = roll(degrees(turn));
            axle.position = {x, turn > 0.0 ? -side : side, radius};
            world.add(world.add_part(object, detail::numbered("wheel", ++number)),
                      cylinder{radius, v.wheel_width}, at * axle);
        }
    }
    return object;
}

}  // namespace gnomon::simulation
