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
#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/detail/normal_equations.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/tangent_basis.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/ray_fit.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// A plane with its covariance.
struct plane_estimate {
    /// In Hesse normal form, towards the view point of the points, or else the origin; without a
    /// normal if the points do not determine one.
    gnomon::plane plane{Eigen::Vector3d(0.0, 0.0, 0.0), 0.0};
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};  ///< of the points on the plane, moved to it [m]
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

/// The number of finite points.
template <class Cloud>
[[nodiscard]] std::size_t count_of(const Cloud& cloud, std::span<const point_index> members) {
    std::size_t count = 0;
    for (const point_index i : members)
        if (cloud.is_finite(i)) count += cloud.counts.empty() ? 1 : cloud.counts[i];
    return count;
}

/// The normal equations of a plane about the mean of the points on it, along their principal axes;
/// nothing if these points do not determine a plane, as where most are off it and few on one line.
template <class Cloud>
[[nodiscard]] std::optional<plane_adjustment<Cloud>> adjustment_of(
    const Cloud& cloud, std::span<const point_index> members, const region_plane& of) {
    const auto is_on = [&](point_index i) { return cloud.is_on(i, of); };
    const gnomon::plane& p = of.plane;
    plane_adjustment<Cloud> first(
        tangent_basis(p.normal),
        combined(1.0, of.centroid, -p.signed_distance(of.centroid), p.normal));
    first.add_all(cloud, members, true, is_on);
    if (first.equations.count == 0) return std::nullopt;
    plane_adjustment<Cloud> principal = first.principal();
    principal.add_all(cloud, members, true, is_on);
    if (!principal.is_determined()) return std::nullopt;
    return principal;
}

/// The covariance of the turns about b1 and b2 and of the shift. A slope towards b2 is a turn about
/// -b1, one towards b1 a turn about b2.
/// @param about     a plane_adjustment
/// @param variance  of the points, in that of their noise. (A template, so that only its users
///                  compile it.)
[[nodiscard]] Eigen::Matrix3d covariance_of_turns(const auto& about, double variance) {
    const auto c = about.covariance();
    constexpr std::size_t slope[] = {1, 0, 2};
    constexpr double sign[] = {-1.0, 1.0, 1.0};
    Eigen::Matrix3d turns;
    for (std::size_t i = 0; i < plane_parameters; ++i) {
        for (std::size_t j = 0; j <= i; ++j) {
            const auto row = static_cast<int>(i), col = static_cast<int>(j);
            turns(row, col) = variance * sign[i] * sign[j] * c[slope[i]][slope[j]];
            turns(col, row) = turns(row, col);
        }
    }
    return turns;
}

/// The plane of some points of a cloud, with its covariance.
/// @param exact  the same points, with the noise of each for itself
template <class Cloud>
[[nodiscard]] plane_estimate estimate_of(const Cloud& cloud, std::span<const point_index> members,
                                         const Cloud& exact) {
    planar_region region = region_of(cloud, members);
    plane_estimate e;
    e.points = region.sums.count;
    if (e.points == 0) return e;
    e.centroid = combined(1.0, cloud.origin, 1.0, region.fit.centroid);
    if (!region.fit.is_determined) return e;
    region = region_along_rays(cloud, members, region);
    e.points = region.sums.count;
    gnomon::plane& plane = region.fit.plane;
    const auto on_plane = std::ranges::find_if(
        members, [&](point_index i) { return cloud.is_finite(i) && cloud.is_on(i, region.fit); });
    if (on_plane != members.end() && dot(plane.normal, cloud.ray(*on_plane)) > 0.0)
        plane = {scaled(-1.0, plane.normal), -plane.offset};
    const auto about = adjustment_of(cloud, members, region.fit);
    if (!about) return e;
    e.centroid = combined(1.0, cloud.origin, 1.0, about->center);
    e.axes = from_columns(about->frame.b1, about->frame.b2, plane.normal);
    e.plane = {plane.normal, dot(plane.normal, e.centroid)};
    e.chi2 = region.fit.chi2;
    e.is_flat =
        region.explains(count_of(cloud, members)) && has_few_off(exact, members, region.fit);
    e.covariance = covariance_of_turns(*about, std::max(e.chi2, 1.0));
    return e;
}

}  // namespace detail

/// The planes of segments. Where rays are known they are of maximum likelihood, with points moved
/// along the rays (detail/ray_fit.hpp); else of smallest variance.
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
