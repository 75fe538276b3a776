// SPDX-License-Identifier: BSL-1.0
/// @file
/// The `ray_caster` concept: caster(ray) returns the nearest hit within the ray's reach, with the
/// surface number of the scene, or nothing. Calls are const and thread-safe.
///
/// Laws, checked in tests/laws/ray_caster_laws.hpp: the result is the nearest of the hits of all
/// shapes, tested one by one.
///
/// Models: `bvh_caster`; `embree_caster` of gnomon/adapters/embree_caster.hpp.
#pragma once

#include <concepts>
#include <optional>

#include <gnomon/simulation/ray.hpp>

namespace gnomon::simulation {

/// A function object that finds the first hit of a ray in a scene.
template <class C>
concept ray_caster = requires(const C& caster, const ray& r) {
    { caster(r) } -> std::same_as<std::optional<ray_hit>>;
};

}  // namespace gnomon::simulation
