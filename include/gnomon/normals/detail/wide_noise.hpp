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
#include <gnomon/core/random.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/measure_noise.hpp>

namespace gnomon::detail {

/// Whether all rays are within 45 degrees of one axis. (A template for compile time only.)
[[nodiscard]] bool are_of_camera(const auto& index, const scratch<point_index>& some) {
    scratch<sampled_plane> rays;
    for (const point_index i : some)
        rays.push_back({difference(index[i], index.viewpoints[i]), {0.0, 0.0, 0.0}});
    return has_length(axis_of_cone(rays));
}

/// Whether all rays of an index are, judged by about 3,000 of its points.
[[nodiscard]] bool is_of_camera(const auto& index) {
    const std::size_t step = std::max<std::size_t>(index.size() / sampled_planes, 1);
    scratch<point_index> some;
    for (std::size_t i = 0; i < index.size(); i += step)
        if (index.is_finite(i)) some.push_back(static_cast<point_index>(i));
    return are_of_camera(index, some);
}

/// The noise of wide planes: that of neighborhoods in about 3,000 points of an index, if it can be
/// measured, and is more.
/// @param noise   that of small neighborhoods
/// @param sparse  memory for the index of these points
template <class X>
[[nodiscard]] noise_curve noise_of_wide_planes(const spatial_index& index, const noise_curve& noise,
                                               spatial_index& sparse, const X& run) {
    const std::size_t thinning = index.finite() / sampled_planes;  // a plane for each point left
    if (thinning < 2) return noise;
    scratch<point_index> some;
    double range = 0.0;
    for (std::size_t i = 0; i < index.size(); ++i) {
        if (!index.is_finite(i) || random_stream(i).bits() % thinning != 0) continue;
        some.push_back(static_cast<point_index>(i));
        range += length(difference(index[i], index.viewpoints[i]));
    }
    if (!are_of_camera(index, some)) return noise;
    sparse.rebuild(subset_view<spatial_index>(index, some), run);
    const measured_noise wide = noise_meter(sparse, run)(sampled_planes / 2, noise);
    range /= static_cast<double>(std::max<std::size_t>(some.size(), 1));
    return wide.curve && (*wide.curve)(range) > noise(range) ? *wide.curve : noise;
}

}  // namespace gnomon::detail
