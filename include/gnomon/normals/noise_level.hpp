// SPDX-License-Identifier: BSL-1.0
/// @file
/// How noisy a cloud is: the standard deviation of its points across the surface, for all that want
/// to know it (`prefer_small_error`, `plane_ekf`, `feature_preserving`) when the data sheet is
/// lost.
///
/// The residual of a fitted plane or quadric is noise only if the neighborhood is much wider than
/// the noise: a ball of radius r that noise fills reads r / sqrt(5). So neighborhoods grow until
/// their radius is four times what they read; and they must be smooth, so that the value is one
/// that 70 % of them exceed: edges count only where they are nearly everywhere.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/local_surface.hpp>
#include <gnomon/normals/detail/quantile.hpp>

namespace gnomon {
namespace detail {

/// `noise_level` of an index, from neighborhoods of up to max_k points.
template <class Index>
[[nodiscard]] double noise_level_in(const Index& points, std::size_t max_k) {
    constexpr std::size_t samples = 500;
    constexpr double smooth_part = 0.3, clearance = 4.0;
    std::vector<std::size_t> chosen;  // evenly from the finite points
    const std::size_t step = std::max<std::size_t>(1, points.finite() / samples);
    for (std::size_t i = 0, finite = 0; i < points.size(); ++i)
        if (points.is_finite(i) && finite++ % step == 0) chosen.push_back(i);
    max_k = std::min(max_k, points.finite());  // there are no more

    double sigma = 0.0;
    scratch<neighbor> neighbors;
    surroundings around;
    std::vector<double> spread, radius;
    for (std::size_t k = std::min<std::size_t>(16, max_k);; k = std::min(2 * k, max_k)) {
        spread.clear();
        radius.clear();
        for (const std::size_t i : chosen) {
            knn{.k = k}.find(points, i, neighbors);
            if (neighbors.size() < 3) return 0.0;  // at most three points are always coplanar
            around.assign(points, i, neighbors);
            const local_fits fits(around, around.last(), 0.0);
            double variance = fits.left_by_plane() / fits.freedom_of_plane();
            if (fits.has_quadric())
                variance = std::min(variance, fits.left_by_quadric() / fits.freedom_of_quadric());
            spread.push_back(std::sqrt(variance));
            radius.push_back(around.radius(around.last()));
        }
        if (chosen.empty()) return 0.0;
        sigma = quantile(spread, smooth_part);
        if (k >= max_k || quantile(radius, 0.5) >= clearance * sigma) return sigma;
    }
}

}  // namespace detail

/// The standard deviation of the points across the surface they lie on [m]; 0 for a clean cloud of
/// flat pieces, and for fewer than four points. One number for all points: of a scanner whose noise
/// grows with range, it is the noise of the typical point. It is too large where parallel
/// surfaces are closer to each other than about eight deviations, and too small for noise so strong
/// that 256 neighbors are not planar (25 % too little at 100,000 points with noise of 1.2 % of the
/// cloud's diagonal). Of 1,000 points or more, those at even distances in their order are looked
/// at, so that another order changes it by a few percent.
///
/// @param points  any point range [m], or an index of it; points that are not finite do not count
/// Complexity: 500 neighborhoods, and O(n log n) for the index if `points` is none.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] double noise_level(const R& points, const X& run = {}, Proj projection = {}) {
    const auto& index = detail::index_of(points, run, projection);
    return detail::noise_level_in(index, 255);
}

}  // namespace gnomon
