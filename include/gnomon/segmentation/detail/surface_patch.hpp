// SPDX-License-Identifier: BSL-1.0
/// @file
/// A region, or several that belong to one surface, as the means of their parts: few numbers, from
/// which follows how well a curved surface explains them, and how well their planes do.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// Parts of a region along each of its principal axes; numerical: a piece of a curved surface has
/// several parts across its curve.
inline constexpr std::size_t parts_along = 8;

/// A part of a region.
struct surface_part {
    Eigen::Vector3d mean;   ///< of its points, from the origin of the cloud [m]
    double weight;          ///< 1 / variance of the mean across the plane of the region [1 / m^2]
    double off_plane;       ///< of the mean [m]
    double reach;           ///< of the noise of a point across the plane: three deviations [m]
    std::size_t count = 0;  ///< of its points
};

/// The parts of one region or several.
struct surface_patch {
    scratch<surface_part> parts;
    plane_sums sums;          ///< of all points
    double excess = 1.0;      ///< the largest of the regions: region_plane::excess
    std::size_t regions = 0;  ///< planar ones

    /// (A template, so that only its users compile it.)
    void add(const auto& more) {
        parts.insert(parts.end(), more.parts.begin(), more.parts.end());
        sums.add(more.sums);
        excess = std::max(excess, more.excess);
        regions += more.regions;
    }
};

/// A part by the sums of its points. (A template, so that only its users compile it.)
/// @param sums    plane_sums of at least one point
/// @param region  the planar_region that it is of
[[nodiscard]] surface_part part_with(const auto& sums, const auto& region) {
    const plane& own = region.fit.plane;
    const Eigen::Vector3d mean = sums.positions.mean();
    const double variance = sums.noise_across(own.normal);  // of the mean
    const double of_point = static_cast<double>(sums.count) * variance * region.fit.excess();
    return {mean, 1.0 / variance, own.signed_distance(mean), most_deviations * std::sqrt(of_point),
            sums.count};
}

}  // namespace gnomon::detail
