// SPDX-License-Identifier: BSL-1.0
/// @file
/// The noise that all steps of `perception` share: that which is given, or measured, or else that
/// across the surfaces, with the reason.
#pragma once

#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/wide_noise.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/normals/noise_level.hpp>

namespace gnomon::detail {

/// The noise along the rays, as given or measured; where it cannot be measured, that across the
/// surfaces, and why.
/// @param result  its `noise` is replaced, in its memory
/// @param chain   whose noise is given, or not
template <class X>
void determine_noise(auto& result, const spatial_index& points, const auto& chain, const X& run) {
    auto& noise = result.noise;
    noise = {};
    if (chain.noise) {
        noise.curve = noise.of_planes = *chain.noise;
        return;
    }
    const measured_noise found = measure_noise(points, run);
    if (found.curve) {
        noise.curve = *found.curve;
        noise.of_planes = noise_of_wide_planes(points, *found.curve, result.memory.sparse, run);
        return;
    }
    noise.curve = noise.of_planes = constant_noise{noise_level(points, run)};
    noise.is_across_surface = true;
    noise.reason = found.reason;
}

/// The same policy for this noise, if it depends on any.
template <class Policy>
[[nodiscard]] Policy with_noise(Policy policy, const noise_curve& noise) {
    if constexpr (requires { policy.noise = noise; }) policy.noise = noise;
    return policy;
}

}  // namespace gnomon::detail
