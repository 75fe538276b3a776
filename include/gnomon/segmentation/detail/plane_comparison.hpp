// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether one plane explains two regions as well as two planes do: the common plane follows from
/// the sums of both, and no point is looked at again.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// The plane of two regions.
[[nodiscard]] inline region_plane plane_of_both(const planar_region& a, const planar_region& b) {
    plane_sums both = a.sums;
    both.add(b.sums);
    return both.fit();
}

/// How much worse one plane explains two regions next to each other than two planes do; at most 1
/// if they may be one: the deviations of either from the common plane are at most half as large
/// again as those from their own.
[[nodiscard]] inline double unlikeness_of_neighbors(const planar_region& a,
                                                    const planar_region& b) {
    constexpr double tolerated = 1.5 * 1.5;  // chosen
    const region_plane both = plane_of_both(a, b);
    if (!both.is_determined) return std::numeric_limits<double>::infinity();
    const double worst = std::max(a.sums.chi2_about(both.plane), b.sums.chi2_about(both.plane));
    return worst / (tolerated * std::max(a.fit.excess(), b.fit.excess()));
}

/// The same of two regions apart, by Chow's test of the equality of two regressions (Chow 1960). As
/// neighboring errors are correlated, and no surface is an exact plane, a region has no more than
/// 50 independent points. A region that is hardly wider than its noise would be of any plane: its
/// own must be nearly parallel to that of both.
[[nodiscard]] inline double unlikeness_of_apart(const planar_region& a, const planar_region& b) {
    constexpr double chi2_of_3 = 13.9;            // 99.7 %, of three degrees of freedom
    constexpr double nearly = 0.906307787036650;  // of 25 degrees; chosen
    constexpr std::size_t most = 50;              // chosen
    const region_plane both = plane_of_both(a, b);
    const auto statistic = [&](const planar_region& r) {
        const double worse = std::max(0.0, r.sums.chi2_about(both.plane) - r.fit.chi2);
        return static_cast<double>(std::min(r.sums.count, most)) * worse / r.fit.excess();
    };
    const auto is_parallel = [&](const planar_region& r) {
        return std::abs(dot(r.fit.plane.normal, both.plane.normal)) >= nearly;
    };
    if (!both.is_determined || !is_parallel(a) || !is_parallel(b))
        return std::numeric_limits<double>::infinity();
    return (statistic(a) + statistic(b)) / chi2_of_3;
}

}  // namespace gnomon::detail
