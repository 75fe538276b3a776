// SPDX-License-Identifier: BSL-1.0
/// @file
/// Noise that neighbors have in common: a depth camera bends a wall by more than single readings
/// scatter, so that a wide plane deviates more than a small neighborhood. That is
/// measured as the noise is, on a few of the points, whose neighborhoods are wide.
#pragma once

#include <algorithm>
#include <cstddef>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/ray_cone.hpp>
#include <gnomon/normals/measure_noise.hpp>

namespace gnomon::detail {

/// The noise of wide planes: that of neighborhoods in about 3,000 points of an index, if it can be
/// measured, and is more.
/// @param noise   that of small neighborhoods
/// @param sparse  memory for the index of these points
template <class X>
[[nodiscard]] noise_curve noise_of_wide_planes(const spatial_index& index, const noise_curve& noise,
                                               spatial_index& sparse, const X& run) {
    if (index.finite() / sampled_planes < 2) return noise;  // a plane for each point left
    const scratch<point_index> some = some_points_of(index, sampled_planes);
    if (!is_of_camera(index, some)) return noise;
    double range = 0.0;
    for (const point_index i : some) range += length(difference(index[i], index.viewpoints[i]));
    sparse.rebuild(subset_view<spatial_index>(index, some), run);
    const measured_noise wide = noise_meter(sparse, run)(sampled_planes / 2, noise);
    range /= static_cast<double>(std::max<std::size_t>(some.size(), 1));
    return wide.curve && (*wide.curve)(range) > noise(range) ? *wide.curve : noise;
}

}  // namespace gnomon::detail
