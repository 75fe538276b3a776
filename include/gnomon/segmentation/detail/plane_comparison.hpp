// SPDX-License-Identifier: BSL-1.0
/// @file
/// Whether one plane explains two regions as well as two planes do: the common plane follows from
/// the sums of both, and no point is looked at again.
#pragma once

#include <algorithm>
#include <limits>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// The plane of two regions.
[[nodiscard]] region_plane plane_of_both(const auto& a, const auto& b) {
    plane_sums both = a.sums;
    both.add(b.sums);
    return both.fit();
}

/// The variance of the tilt of a plane about an axis in it [rad^2]; infinite for a strip along the
/// axis that is no wider than its noise.
[[nodiscard]] double tilt_variance(const auto& region, const Eigen::Vector3d& axis) {
    const Eigen::Vector3d& n = region.fit.plane.normal;
    const Eigen::Vector3d across = cross(n, axis);
    const double spread = dot(across, product(region.sums.positions.covariance(), across));
    const double own = spread - region.sums.noise_along(across);
    if (!(own > 0.0)) return std::numeric_limits<double>::infinity();
    return region.fit.excess() * region.sums.noise_across(n) * spread / (own * own);
}

/// Whether two planes are turned by more than an angle, and by more than three standard deviations
/// more.
[[nodiscard]] bool are_turned(const auto& a, const auto& b, angle least) {
    if (!a.fit.is_determined || !b.fit.is_determined) return false;
    const double cosine = std::abs(dot(a.fit.plane.normal, b.fit.plane.normal));
    if (cosine >= cos(least)) return false;
    const Eigen::Vector3d axis = direction_of(cross(a.fit.plane.normal, b.fit.plane.normal));
    const double beyond = std::acos(cosine) - least.radians();
    return beyond > most_deviations * std::sqrt(tilt_variance(a, axis) + tilt_variance(b, axis));
}

/// Planes that meet at more do so at an edge, which is as sharp as the noise lets it be seen.
inline constexpr angle widest_crease = degrees(30);  // numerical

/// Whether two planes certainly meet at an edge, even of a surface that is rough.
[[nodiscard]] bool are_at_edge(const auto& a, const auto& b) {
    // By less, rough surfaces are several planes; chosen on furnished rooms 20,001 to 20,012 and
    // an office (pcl_office1_kinect).
    constexpr angle least = degrees(60);
    return are_turned(a, b, least);
}

/// Whether two planes meet at a crease: noise explains either of them, though perhaps both by a
/// common one as well.
[[nodiscard]] bool are_at_crease(const auto& a, const auto& b) {
    // By less, walls bend; chosen on streets 20,001 to 20,003 and scans of range finders
    // (asl_apartment_0, lms400_table_scene_1cm, pcl_room_scan1).
    constexpr angle least = degrees(3);
    return std::max(a.fit.chi2, b.fit.chi2) <= region_plane::most_excess && are_turned(a, b, least);
}

/// The variance of the height of the plane of a region at a place [m^2]: that of its mean, and the
/// more for its tilt, the farther the place is.
[[nodiscard]] double height_variance(const auto& region, const Eigen::Vector3d& place) {
    const Eigen::Vector3d away = difference(place, region.fit.centroid);
    const double squared = dot(away, away);
    const double spread = dot(away, product(region.sums.positions.covariance(), away));
    const double leverage = spread > 0.0 ? squared * squared / spread : 0.0;
    return region.fit.excess() * region.sums.noise_across(region.fit.plane.normal) *
           (1.0 + leverage);
}

/// Whether the plane of a region is nearly parallel to that of a larger whole.
[[nodiscard]] bool is_nearly_parallel(const auto& fit, const region_plane& whole) {
    constexpr angle max_angle = degrees(15);  // rho_a of the thesis, Sec. 4.4.1
    return std::abs(dot(fit.plane.normal, whole.plane.normal)) >= min_cosine(max_angle);
}

/// Whether there is a step between two planes: noise explains either of them, though perhaps both
/// by a common one as well; they are nearly parallel; and at the middle of the smaller region they
/// are farther from each other than 1 cm, as no surface is an exact plane, by more than three
/// standard deviations more.
[[nodiscard]] bool are_at_step(const auto& a, const auto& b) {
    if (b.sums.count < a.sums.count) return are_at_step(b, a);
    if (!a.fit.is_determined || !b.fit.is_determined) return false;
    if (std::max(a.fit.chi2, b.fit.chi2) > region_plane::most_excess) return false;
    if (!is_nearly_parallel(a.fit, b.fit)) return false;
    const Eigen::Vector3d& middle = a.fit.centroid;
    const double uncertain = height_variance(a, middle) + height_variance(b, middle);
    return std::abs(b.fit.plane.signed_distance(middle)) >
           certain_deviations * flatness + most_deviations * std::sqrt(uncertain);
}

/// Whether two planes that are next to each other must not become one, though noise may explain
/// both by one.
[[nodiscard]] bool are_at_crease_or_step(const auto& a, const auto& b) {
    return are_at_crease(a, b) || are_at_step(a, b);
}

/// How much worse one plane explains two regions next to each other than two planes do; at most 1
/// if they may be merged: they do not meet at an edge, and the variance of either about the common
/// plane is at most 2.5 times the larger of those about their own, which count as 1 to 2.5 times
/// that of the noise.
[[nodiscard]] double dissimilarity_of_neighbors(const auto& a, const auto& b) {
    if (are_at_edge(a, b)) return std::numeric_limits<double>::infinity();
    const region_plane both = plane_of_both(a, b);
    if (!both.is_determined) return std::numeric_limits<double>::infinity();
    const double worst = std::max(a.sums.chi2_about(both.plane), b.sums.chi2_about(both.plane));
    return worst / (region_plane::most_excess * std::max(a.fit.excess(), b.fit.excess()));
}

/// How much worse one plane explains two regions apart, by Chow's test of the equality of two
/// regressions (Chow 1960); at most 1 if they may be merged. Almost any plane explains a region
/// that is hardly wider than its noise: its own must be nearly parallel to that of both.
[[nodiscard]] double dissimilarity_of_apart(const auto& a, const auto& b) {
    constexpr double chi2_of_3 = 13.9;  // 99.7 %, of three degrees of freedom
    const region_plane both = plane_of_both(a, b);
    const auto statistic = [&](const auto& r) {
        const double worse = std::max(0.0, r.sums.chi2_about(both.plane) - r.fit.chi2);
        return static_cast<double>(r.sums.count) * worse / r.fit.excess();
    };
    if (!both.is_determined || !is_nearly_parallel(a.fit, both) || !is_nearly_parallel(b.fit, both))
        return std::numeric_limits<double>::infinity();
    return (statistic(a) + statistic(b)) / chi2_of_3;
}

}  // namespace gnomon::detail
