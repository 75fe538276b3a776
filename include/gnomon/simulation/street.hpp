// SPDX-License-Identifier: BSL-1.0
/// @file
/// Random streets, one for each seed: a road between kerbs and pavements, rows of houses, hedges,
/// trees, poles, and parked and driving vehicles.
#pragma once

#include <cstdint>

#include <gnomon/core/error.hpp>
#include <gnomon/simulation/detail/street_builder.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation::scenes {

/// Options of street().
struct street_options {
    double length = 120.0;  ///< along x, with the sensor in the middle [m]
    double kerb = 0.12;     ///< height of the pavements above the sides of the road [m]
    double crown = 0.0;     ///< height of the middle of the road above its sides [m]
    bool plain = false;     ///< facades are rectangles, and vehicles are boxes
    bool own_car = false;   ///< a car below the sensor, which stands where the street's sensor is
    std::uint64_t seed = 1;
};

/// A straight street along x on the plane z = 0, above which a road may be curved: a road of two
/// lanes of 3.0 to 3.4 m and two rows of parked vehicles, pavements of 2.8 to 3.8 m and houses of 2
/// to 4 storeys, half of them behind hedges. The sensor is level, on the right lane, 1.7 to 2.0 m
/// above the road, and looks along the lane; no vehicle is less than 6 m before or behind it in its
/// lane. Windows reflect as walls do, and all vehicles stand still.
///
/// Objects have stable names, with numbers from 1 for each kind; objects of the left side come
/// first. The surfaces that a segmentation should find whole, by their full names:
///
///     road/body/plane                  pavement left/body/plane       kerb left/body/plane
///     house 3/facade/wall              house 3/facade/window 5        house 3/facade/door
///     house 3/shell/left, right        house 3/shell/roof front
///     car 2/body/left                  van 1/cabin/windscreen         own car/cabin/roof
///     tree 1/trunk/mantle              tree 1/crown/leaves            hedge 1/body/leaves
///     pole 1/post/mantle               pole 1/sign/-x                 pole 2/lamp/-z
///
/// In a plain street, the same objects stand at the same places; a vehicle has the sides of a box,
/// "body/+x" to "body/-z".
///
/// The wall of a facade is one surface without its recesses, which are 0.10 to 0.20 m deep. The
/// kerb is the upright step only; its upper side belongs to the pavement.
/// @throws std::invalid_argument  unless the length is from 20 to 1,000 m, the kerb from 0.01 to
///                                0.5 m high and the crown of the road from 0 to 0.5 m
[[nodiscard]] inline scene street(const street_options& options = {}) {
    gnomon::detail::require(options.length >= 20.0 && options.length <= 1000.0,
                            "street: the length must be from 20 to 1,000 m");
    gnomon::detail::require(options.kerb >= 0.01 && options.kerb <= 0.5,
                            "street: the kerb must be from 0.01 to 0.5 m high");
    gnomon::detail::require(options.crown >= 0.0 && options.crown <= 0.5,
                            "street: the crown of the road must be from 0 to 0.5 m high");
    detail::street_builder builder(options.length, options.kerb, options.crown, options.plain,
                                   options.seed);
    if (options.own_car) builder.add_own_car();
    return builder.world();
}

}  // namespace gnomon::simulation::scenes
