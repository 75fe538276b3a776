// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a segment: fit to those of its points that are on it, with its covariance, and
/// whether the segment is flat.
///
///     const auto planes = gnomon::estimate_planes(scan, seen.surfaces, noise);
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// A plane with its covariance.
struct plane_estimate {
    /// In Hesse normal form, towards the view point of the points, or else the origin; without a
    /// normal if the points do not determine one.
    gnomon::plane plane{Eigen::Vector3d(0.0, 0.0, 0.0), 0.0};
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};  ///< of the points on the plane [m]
    /// Unit columns: the directions of largest and second largest variance in the plane, and its
    /// normal.
    Eigen::Matrix3d axes = detail::diagonal(1.0, 1.0, 1.0);
    /// Of the turns about axes 0 and 1 [rad], and of the shift along the normal at the centroid
    /// [m].
    Eigen::Matrix3d covariance = detail::diagonal(0.0, 0.0, 0.0);
    double chi2 = 0.0;       ///< mean squared deviation, in variances of the noise
    std::size_t points = 0;  ///< on the plane, which is fit to them
    /// Whether the plane explains the segment, as `estimate_planes` defines.
    bool is_flat = false;
};

namespace detail {

/// Whether fewer than 30 points are certain outliers of a plane, which may be rough.
template <class Cloud>
[[nodiscard]] bool has_few_off(const Cloud& cloud, std::span<const point_index> members,
                               const region_plane& of) {
    constexpr std::ptrdiff_t fewest_off = 30;  // n_min of the thesis: no noise
    const auto is_off = [&](point_index i) {
        return cloud.is_finite(i) &&
               std::abs(of.plane.signed_distance(cloud.offsets[i])) >
                   std::sqrt(of.excess()) * cloud.noise[i].certain_reach(of.plane.normal);
    };
    return std::ranges::count_if(members, is_off) < fewest_off;
}

/// The plane of some points of a cloud, with its covariance.
/// @param exact  the same points, with the noise of each for itself
template <class Cloud>
[[nodiscard]] plane_estimate estimate_of(const Cloud& cloud, std::span<const point_index> members,
                                         const Cloud& exact) {
    const auto& [sums, fit, is_planar] = region_of(cloud, members);
    plane_estimate e;
    e.points = sums.count;
    if (e.points == 0) return e;
    e.centroid = combined(1.0, cloud.origin, 1.0, fit.centroid);
    if (!fit.is_determined) return e;
    const eigen_decomposition principal = symmetric_eigen(sums.positions.covariance());
    const auto on_plane = std::ranges::find_if(
        members, [&](point_index i) { return cloud.is_finite(i) && cloud.is_on(i, fit); });
    const bool is_away =
        on_plane != members.end() && dot(fit.plane.normal, cloud.ray(*on_plane)) > 0.0;
    const Eigen::Vector3d n = scaled(is_away ? -1.0 : 1.0, fit.plane.normal);
    const Eigen::Vector3d first = column(principal.vectors, 0);
    e.axes = from_columns(first, cross(n, first), n);
    e.plane = {n, dot(n, e.centroid)};
    e.chi2 = fit.chi2;
    e.is_flat = is_planar && has_few_off(exact, members, fit);
    // A turn about one axis moves the points along the other one.
    const double shift = std::max(fit.chi2, 1.0) * sums.noise_across(n);
    e.covariance = diagonal(shift / principal.values[1], shift / principal.values[0], shift);
    return e;
}

}  // namespace detail

/// The planes of segments.
///
/// @param points  any point range of n points [m]; where view points are known, noise lies along
///                the rays, else it is the same in all directions
/// @param parts   segments of these points
/// @param noise   of the sensor
/// @return an estimate for each segment. It is flat if most of its points are on the plane, within
///         three standard deviations of the region (at least those of the noise); fewer than 30 are
///         farther from it than five of the noise and 1 cm, both times the root of `chi2`, clamped
///         to [1, 2.5]; their variance is at most 2.5 times that of the noise; and the plane is not
///         seen edge-on
/// @throws std::invalid_argument  if points, segments or view points differ in number
/// Complexity: O(n), and an index if `points` is none.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<plane_estimate> estimate_planes(const R& points, const segments& parts,
                                                          const noise_curve& noise,
                                                          const X& run = {}, Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::require(parts.labels().size() == index.size(),
                    "estimate_planes: the numbers of points and of labels differ");
    const detail::planar_cloud cloud(index, noise, team);
    std::vector<plane_estimate> planes(parts.size());
    team(parts.size(), [&](std::size_t s) {
        if (!parts[s].empty()) planes[s] = detail::estimate_of(cloud, parts[s], cloud);
    });
    return planes;
}

}  // namespace gnomon
