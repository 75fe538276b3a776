// SPDX-License-Identifier: BSL-1.0
/// @file
/// The `shape` concept: surfaces that rays intersect.
///
/// A shape has a local frame and consists of one or more numbered surfaces, such as the sides of a
/// box. It provides its bounds and the first intersection with a ray, from outside or from inside
/// (so that a box can serve as a room).
///
/// Laws, checked in tests/laws/shape_laws.hpp for every model: the hit lies on the ray within its
/// reach and in the bounds; the normal has unit length and faces the ray's origin; the number of
/// the surface is below the number of names; a shorter reach removes the hits beyond it and changes
/// no other; the next hit along a ray is the same from every origin between the two hits; the ray
/// in the opposite direction meets no further surface; a ray with direction 0 or with NaN has no
/// hit.
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

namespace gnomon::simulation {

/// One or more surfaces that rays intersect, in the shape's local frame [m]: extent() returns its
/// bounds; first_hit(r) the nearest hit within the ray's reach, for a direction of unit length;
/// surface_names() one name per surface number. Calls are const and thread-safe.
template <class S>
concept shape = requires(const S& s, const ray& r) {
    { s.extent() } -> std::same_as<bounds>;
    { s.first_hit(r) } -> std::same_as<std::optional<ray_hit>>;
    { s.surface_names().size() } -> std::convertible_to<std::size_t>;
    { *s.surface_names().begin() } -> std::convertible_to<std::string_view>;
};

}  // namespace gnomon::simulation
