// SPDX-License-Identifier: BSL-1.0
/// @file
/// What noise is a function of: the range, as for range finders, or the depth along an optical
/// axis, as for cameras.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/normals/detail/noise_fit.hpp>
#include <gnomon/normals/detail/residual_sampler.hpp>

namespace gnomon::detail {

/// What noise is a function of: the range, or the depth along an optical axis.
struct noise_coordinate {
    Eigen::Vector3d axis{0.0, 0.0, 0.0};  ///< of length 1; 0 for the range

    /// 1 for the range; else the cosine between ray and axis.
    [[nodiscard]] double cosine(const Eigen::Vector3d& ray) const {
        return dot(axis, axis) > 0.0 ? std::abs(dot(ray, axis)) / length(ray) : 1.0;
    }
    /// How much the coordinate changes along a plane, for each metre across the ray.
    [[nodiscard]] double slope(const sampled_plane& s) const {
        const Eigen::Vector3d way = dot(axis, axis) > 0.0 ? axis : direction_of(s.ray);
        const double c = dot(s.normal, way);
        return std::sqrt(std::max(0.0, 1.0 - c * c)) / std::abs(c);
    }
    /// The range, or the depth, of the point at the end of a ray [m].
    [[nodiscard]] double operator()(const Eigen::Vector3d& ray) const {
        return length(ray) * cosine(ray);
    }
};

/// The residuals of planes as errors of a coordinate. Of quantized readings, those of planes that
/// cross fewer steps than `crossed`, or are exact planes through two or three of them, are left
/// out: there the errors of rounding are not independent of each other.
[[nodiscard]] scratch<value_at> residuals_of(const auto& planes, const noise_coordinate& coordinate,
                                             const even_quartic& quantized, double crossed) {
    // Of the variance of rounding: its estimate from 17 points is below a quarter of it in two of
    // 1,000 cases (chi^2 with 14 degrees of freedom).
    constexpr double exact = 0.25;
    scratch<value_at> residuals;
    for (const sampled_plane& s : planes) {
        if (dot(s.normal, s.normal) == 0.0) continue;
        const double cosine = coordinate.cosine(s.ray), x = length(s.ray) * cosine;
        const double span = 2.0 * s.radius * coordinate.slope(s);
        const double value = s.variance * cosine * cosine;
        if (span * span >= crossed * crossed * 12.0 * quantized(x) && value >= exact * quantized(x))
            residuals.push_back({x, value});
    }
    return residuals;
}

/// Whether all rays are parallel, to a tenth of a degree: of points at world coordinates whose view
/// point is given as the origin.
[[nodiscard]] bool are_parallel(const auto& planes) {
    constexpr double most = 0.0017;  // [rad]; no sensor has so narrow a field of view
    const Eigen::Vector3d first = direction_of(planes.front().ray);
    return std::all_of(planes.begin(), planes.end(), [&](const sampled_plane& s) {
        return length(difference(direction_of(s.ray), first)) < most;
    });
}

}  // namespace gnomon::detail
