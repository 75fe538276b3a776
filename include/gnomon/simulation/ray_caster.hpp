// SPDX-License-Identifier: BSL-1.0
/// @file
/// What does a ray meet first? The `ray_caster` concept: caster(ray) gives the nearest hit within
/// the ray's reach, the numbers of surfaces being those of a scene, or nothing. Const and
/// thread-safe.
///
/// Laws, checked in tests/laws/ray_caster_laws.hpp: the answer is that of asking all shapes of the
/// scene one by one.
///
/// Models: `bvh_caster`; `embree_caster` of gnomon/adapters/embree_caster.hpp.
#pragma once

#include <concepts>
#include <optional>

#include <gnomon/simulation/ray.hpp>

namespace gnomon {

/// Whatever finds the first hit of a ray.
template <class C>
concept ray_caster = requires(const C& caster, const ray& r) {
    { caster(r) } -> std::same_as<std::optional<ray_hit>>;
};

}  // namespace gnomon
