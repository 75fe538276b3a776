// SPDX-License-Identifier: BSL-1.0
/// @file
/// How many neighbors the density of points allows.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::recognition::detail {

/// The number of neighbors within `reach` [m] at the median density of points on their surface, by
/// the distance of the fourth nearest, but at least 10 and at most k. O(log n) for n points.
[[nodiscard]] inline std::size_t neighbors_by_density(const spatial_index& points, std::size_t k,
                                                      double reach) {
    constexpr std::size_t nearby = 4, least = 10;  // chosen on furniture_models(), seed 7
    constexpr std::size_t enough = 2000;           // performance only: points, evenly chosen
    const std::size_t n = std::min(points.finite(), enough);
    std::vector<double> squared;
    std::vector<neighbor> nearest;
    for (std::size_t i = 0; i < n; ++i) {
        const std::size_t place = i * points.finite() / n;
        points.nearest_into(nearest, points[points.tree().index()[place]], nearby + 1);
        if (nearest.size() > nearby) squared.push_back(nearest.back().squared_distance);
    }
    if (squared.empty()) return std::min(least, k);
    const auto middle = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
    std::nth_element(squared.begin(), middle, squared.end());
    // As many as a disc of this radius has at the density of the disc of the nearest ones.
    const double within = static_cast<double>(nearby) * reach * reach / *middle;
    if (!(within < static_cast<double>(k))) return k;  // also for points at one place
    return std::min(k, std::max(least, static_cast<std::size_t>(within)));
}

}  // namespace gnomon::recognition::detail
