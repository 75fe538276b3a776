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

/// About 3,000 of the finite points of an index, drawn at random; all of fewer than 6,000. (A
/// template, as the next one, for compile time only.)
[[nodiscard]] scratch<point_index> some_points_of(const auto& index) {
    const std::size_t thinning = std::max<std::size_t>(index.finite() / sampled_planes, 1);
    scratch<point_index> some;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index.is_finite(i) && random_stream(i).bits() % thinning == 0)
            some.push_back(static_cast<point_index>(i));
    return some;
}

/// Whether all rays of an index are within 45 degrees of one axis, as those of a depth camera;
/// tested on some of them.
[[nodiscard]] bool is_of_camera(const auto& index, const scratch<point_index>& some) {
    scratch<sampled_plane> rays;
    for (const point_index i : some)
        rays.push_back({difference(index[i], index.viewpoints[i]), {0.0, 0.0, 0.0}});
    return has_length(axis_of_cone(rays));
}

/// The noise of wide planes: that of neighborhoods in about 3,000 points of an index, if it can be
/// measured, and is more.
/// @param noise   that of small neighborhoods
/// @param sparse  memory for the index of these points
template <class X>
[[nodiscard]] noise_curve noise_of_wide_planes(const spatial_index& index, const noise_curve& noise,
                                               spatial_index& sparse, const X& run) {
    if (index.finite() / sampled_planes < 2) return noise;  // a plane for each point left
    const scratch<point_index> some = some_points_of(index);
    if (!is_of_camera(index, some)) return noise;
    double range = 0.0;
    for (const point_index i : some) range += length(difference(index[i], index.viewpoints[i]));
    sparse.rebuild(subset_view<spatial_index>(index, some), run);
    const measured_noise wide = noise_meter(sparse, run)(sampled_planes / 2, noise);
    range /= static_cast<double>(std::max<std::size_t>(some.size(), 1));
    return wide.curve && (*wide.curve)(range) > noise(range) ? *wide.curve : noise;
}

}  // namespace gnomon::detail
