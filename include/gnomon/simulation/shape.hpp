// SPDX-License-Identifier: BSL-1.0
/// @file
/// What scenes are made of: the `shape` concept.
///
/// A shape lies in a frame of its own and consists of one or more numbered surfaces, such as the
/// sides of a box. It is asked for two things: a box about it, and the first point where a ray
/// crosses it, from outside or from within (so that a box is a room, too).
///
/// Laws, checked in tests/laws/shape_laws.hpp for every model: the hit lies on the ray within its
/// reach and in the bounds; the normal has unit length and faces the ray's origin; the number of
/// the surface is below the number of names; a shorter reach changes nothing but to hide hits
/// beyond it; a ray that starts behind the hit sees what follows, from wherever it starts on the
/// way there, and nothing is seen from the other end that is not seen from within; a ray of no
/// direction, or with NaN, meets nothing.
///
/// Models: `box`, `plane_patch`, `cylinder`, `cone`, `sphere`, `surface_of_revolution`,
/// `triangle_mesh`.
#pragma once

#include <concepts>
#include <cstddef>
#include <optional>
#include <string_view>

#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/ray.hpp>

namespace gnomon {

/// A surface, or several, that rays meet. In the shape's own frame, [m]: extent() are bounds about
/// it; first_hit(r) is the nearest hit of the ray within its reach, r.direction being of unit
/// length; surface_names() has one name for each number that hits tell. Calls are const and
/// thread-safe.
template <class S>
concept shape = requires(const S& s, const ray& r) {
    { s.extent() } -> std::same_as<bounds>;
    { s.first_hit(r) } -> std::same_as<std::optional<ray_hit>>;
    { s.surface_names().size() } -> std::convertible_to<std::size_t>;
    { *s.surface_names().begin() } -> std::convertible_to<std::string_view>;
};

}  // namespace gnomon
