// SPDX-License-Identifier: BSL-1.0
/// @file
/// The noise that all steps of `perception` share: that which is given, or measured, or else that
/// across the surfaces, with the reason.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/range_noise.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/ray_cone.hpp>
#include <gnomon/normals/detail/wide_noise.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/normals/noise_level.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// The root mean square of the noise of some of the points [m].
[[nodiscard]] double mean_noise(const auto& points, const noise_curve& noise) {
    double sum = 0.0;
    const scratch<point_index> some = some_points_of(points, sampled_planes);
    for (const point_index i : some)
        sum += noise.variance_along(difference(points[i], points.viewpoints[i]));
    return some.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(some.size()));
}

/// The standard deviation of the rounding of coordinates to the numbers that they came in, at most
/// [m]: floats of maps are half a metre apart.
[[nodiscard]] inline double rounding_of(const spatial_index& points) {
    double largest = 0.0;
    if (points.tree().size() > 0) {
        const leaf_box& box = points.tree().box();
        for (std::size_t a = 0; a < 3; ++a)
            largest = std::max({largest, std::abs(box.low[a]), std::abs(box.high[a])});
    }
    constexpr double uniform = 12.0;  // formula: the variance of one is its squared width over this
    return points.epsilon() * largest / std::sqrt(uniform);
}

/// The noise along the rays, as given or measured; where it cannot be measured, that across the
/// surfaces, and why. Noise across the surfaces is at least the rounding of coordinates, which is
/// the reason where it is more than the flatness of planes. Planes that scatter by more than the
/// given noise have the measured one.
/// @param result  its `noise` is replaced, in its memory
/// @param chain   whose noise is given, or not
template <class Chain, class X>
void determine_noise(auto& result, const spatial_index& points, const Chain& chain, const X& run) {
    auto& noise = result.noise;
    const std::optional<noise_curve>& given = chain.noise;
    noise = {};
    if (given) noise.curve = noise.of_planes = *given;
    if (given && !Chain::is_on_cells) return;
    const measured_noise found = measure_noise(points, run);
    if (found.curve) {
        const noise_curve of_planes =
            noise_of_wide_planes(points, *found.curve, result.memory.sparse, run);
        if (!given) noise.curve = *found.curve;
        if (!given || mean_noise(points, of_planes) > mean_noise(points, *given))
            noise.of_planes = of_planes;
    } else if (!given) {
        const double rounding = rounding_of(points);
        noise.curve = noise.of_planes =
            constant_noise{std::max(rounding, noise_level(points, run))};
        noise.is_across_surface = true;
        noise.reason = rounding > flatness
                           ? "coordinates are rounded: subtract an offset before they become floats"
                           : found.reason;
    }
}

/// The same policy for this noise, if it depends on any.
template <class Policy>
[[nodiscard]] Policy with_noise(Policy policy, const noise_curve& noise) {
    if constexpr (requires { policy.noise = noise; }) policy.noise = noise;
    return policy;
}

}  // namespace gnomon::detail
