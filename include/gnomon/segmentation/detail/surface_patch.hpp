// SPDX-License-Identifier: BSL-1.0
/// @file
/// A region, or several that belong to one surface, as the means of their parts: few numbers, from
/// which follows how well a curved surface explains them, and how well their planes do.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// Parts of a region along each of its principal axes; numerical: a piece of a curved surface has
/// several parts across its curve.
inline constexpr std::size_t parts_along = 8;

/// A grid of parts over the extent of some places.
class part_grid {
  public:
    part_grid(const Eigen::Vector3d& along, const Eigen::Vector3d& across) : axes_{along, across} {}

    void enclose(const Eigen::Vector3d& place) {
        for (std::size_t a = 0; a < 2; ++a) {
            low_[a] = std::min(low_[a], dot(axes_[a], place));
            high_[a] = std::max(high_[a], dot(axes_[a], place));
        }
    }
    [[nodiscard]] std::size_t part_of(const Eigen::Vector3d& place) const {
        return number(0, place) * parts_along + number(1, place);
    }

  private:
    [[nodiscard]] std::size_t number(std::size_t a, const Eigen::Vector3d& place) const {
        const double extent = high_[a] - low_[a];
        if (!(extent > 0.0)) return 0;
        constexpr auto parts = static_cast<double>(parts_along);
        return static_cast<std::size_t>(
            std::clamp(parts * (dot(axes_[a], place) - low_[a]) / extent, 0.0, parts - 1.0));
    }

    static constexpr double none = std::numeric_limits<double>::infinity();
    std::array<Eigen::Vector3d, 2> axes_;
    std::array<double, 2> low_{none, none}, high_{-none, -none};
};

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

    void add(const surface_patch& more) {
        parts.insert(parts.end(), more.parts.begin(), more.parts.end());
        sums.add(more.sums);
        excess = std::max(excess, more.excess);
        regions += more.regions;
    }
};

/// A part by the sums of its points; some.
/// @param region  that it is of
[[nodiscard]] surface_part part_with(const auto& sums, const auto& region) {
    const plane& own = region.fit.plane;
    const Eigen::Vector3d mean = sums.positions.mean();
    const double variance = sums.noise_across(own.normal);  // of the mean
    const double of_point = static_cast<double>(sums.count) * variance * region.fit.excess();
    return {mean, 1.0 / variance, own.signed_distance(mean), most_deviations * std::sqrt(of_point),
            sums.count};
}

/// The parts of a planar region. O(n)
/// @param cloud    a planar_cloud
/// @param members  of the region, all finite
template <class Cloud>
[[nodiscard]] surface_patch patch_of(const Cloud& cloud, const planar_region& region,
                                     std::span<const point_index> members) {
    const eigen_decomposition principal = symmetric_eigen(region.sums.positions.covariance());
    part_grid grid(column(principal.vectors, 0), column(principal.vectors, 1));
    for (const point_index i : members) grid.enclose(cloud.offsets[i]);
    std::array<plane_sums, parts_along * parts_along> sums{};
    for (const point_index i : members) cloud.add(i, sums[grid.part_of(cloud.offsets[i])]);
    surface_patch patch{{}, region.sums, region.fit.excess(), 1};
    for (const plane_sums& part : sums)
        if (part.count > 0) patch.parts.push_back(part_with(part, region));
    return patch;
}

}  // namespace gnomon::detail
