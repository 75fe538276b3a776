// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane of a region by maximum likelihood where rays are known: the squares of the errors of
/// the ranges are minimized, in variances of their noise, by the method of Gauss and Newton.
///
/// The plane of smallest variance, from which it starts, takes noise as isotropic: of a strip that
/// is hardly wider than the noise, its normal is in the surface and not across. Here each point is
/// moved along its ray to the plane, where it is free of noise, before it has a lever arm.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/detail/normal_equations.hpp>
#include <gnomon/normals/detail/tangent_basis.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

inline constexpr std::size_t plane_parameters = 3;  // formula: two slopes and a shift

/// The normal equations of a plane about points that are moved to it: residuals are distances from
/// the plane in standard deviations of the noise across it, parameters the slopes of the plane
/// towards b1 and b2 and its shift along the normal at the center [m].
/// @tparam Cloud  a planar_cloud
template <class Cloud>
struct plane_adjustment {
    tangent_basis frame;
    Eigen::Vector3d center;  ///< of the plane [m]
    normal_equations<plane_parameters> equations;
    weighted_moments moved;             ///< of the points on the plane, from the center [m]
    double least_moved = sin(edge_on);  ///< cosine of normal and ray

    plane_adjustment(const tangent_basis& basis, const Eigen::Vector3d& on_plane)
        : frame(basis), center(on_plane) {}

    /// @param moves  whether the point is moved along its ray; else along the normal
    void add(const Eigen::Vector3d& x, const point_noise& noise, double points, bool moves) {
        const Eigen::Vector3d offset = difference(x, center);
        const double distance = dot(frame.normal, offset);
        const double cosine = dot(frame.normal, noise.ray);
        moves = moves && std::abs(cosine) > least_moved;
        const Eigen::Vector3d m = combined(1.0, offset, -distance / (moves ? cosine : 1.0),
                                           moves ? noise.ray : frame.normal);
        const double weight = std::sqrt(points) / noise.across(frame.normal);
        equations.add({weight * dot(frame.b1, m), weight * dot(frame.b2, m), -weight},
                      weight * distance);
        moved.add(m, points / (noise.sigma * noise.sigma));
    }

    /// Of some points of a cloud.
    void add_all(const Cloud& cloud, std::span<const point_index> members, bool moves,
                 auto&& is_of) {
        for (const point_index i : members) {
            if (!cloud.is_finite(i) || !is_of(i)) continue;
            const double points = cloud.counts.empty() ? 1.0 : static_cast<double>(cloud.counts[i]);
            add(cloud.offsets[i], cloud.noise[i], points, moves && cloud.noise[i].has_ray());
        }
    }

    /// Whether the points determine all parameters, up to rounding.
    [[nodiscard]] bool is_determined() const {
        return scaled_equations<plane_parameters>(equations).is_regular();
    }

    /// The covariance of the parameters. Precondition: is_determined().
    [[nodiscard]] auto covariance() const {
        return scaled_equations<plane_parameters>(equations).covariance();
    }

    /// The plane after a step of the parameters.
    [[nodiscard]] plane_adjustment after(const std::array<double, plane_parameters>& step) const {
        const Eigen::Vector3d n = combined(1.0, frame.normal, step[0], frame.b1, step[1], frame.b2);
        return {tangent_basis(scaled(1.0 / length(n), n), frame),
                combined(1.0, center, step[2], frame.normal)};
    }

    /// The same plane about the mean of the moved points, with b1 along their largest variance.
    /// Precondition: there are points.
    [[nodiscard]] plane_adjustment principal() const {
        const Eigen::Vector3d first = column(symmetric_eigen(moved.covariance()).vectors, 0);
        const Eigen::Vector3d mean = moved.mean();
        plane_adjustment same(
            frame, combined(1.0, center, 1.0, mean, -dot(frame.normal, mean), frame.normal));
        same.frame.b1 = first;
        same.frame = tangent_basis(frame.normal, same.frame);
        return same;
    }
};

/// The region of the same plane by maximum likelihood, of the points that are on it; or `start`, if
/// no ray is known, or if most of its points would not be on that plane.
/// @param start  of these points, with a plane
template <class Cloud>
[[nodiscard]] planar_region region_along_rays(const Cloud& cloud,
                                              std::span<const point_index> members,
                                              const planar_region& start) {
    const auto is_on_start = [&](point_index i) { return cloud.is_on(i, start.fit); };
    Eigen::Vector3d sum(0.0, 0.0, 0.0);
    for (const point_index i : members)
        if (cloud.is_finite(i)) sum = combined(1.0, sum, 1.0, cloud.noise[i].ray);
    if (!has_length(sum)) return start;
    // The regression of the depth along the mean ray is linear, and for parallel rays the result.
    plane_adjustment<Cloud> next(tangent_basis(direction_of(sum)), start.fit.centroid);
    next.add_all(cloud, members, false, is_on_start);
    next = next.after(linear_solution(next.equations));

    const auto plane_of = [](const auto& of) {
        return gnomon::plane{of.frame.normal, dot(of.frame.normal, of.center)};
    };
    planar_region region = start;
    constexpr int most_passes = 50;  // numerical: five are the rule
    for (int pass = 0; pass < most_passes; ++pass) {
        const gnomon::plane plane = plane_of(next);
        if (!all_finite(plane.normal) || !std::isfinite(plane.offset)) return start;
        const region_plane fit = pass == 0 ? start.sums.about(plane) : region.sums.about(plane);
        planar_region on;
        const auto is_on = [&](point_index i) { return cloud.is_on(i, fit); };
        next.add_all(cloud, members, true, [&](point_index i) {
            if (!is_on(i)) return false;
            cloud.add(i, on.sums);
            return true;
        });
        if (2 * on.sums.count < start.sums.count || on.sums.count < plane_parameters) return start;
        const auto step = linear_solution(next.equations);
        double decrease = 0.0;  // of the sum of squares, by this step
        for (std::size_t k = 0; k < step.size(); ++k) decrease -= step[k] * next.equations.right[k];
        next = next.after(step);
        const bool rests = on.sums.count == region.sums.count;
        region = on;
        region.fit = on.sums.about(plane_of(next));
        constexpr double negligible = 1e-8;  // numerical: squared standard deviations
        if (rests && decrease <= negligible) break;
    }
    return region;
}

}  // namespace gnomon::detail
