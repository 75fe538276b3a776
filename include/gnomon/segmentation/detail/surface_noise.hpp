// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far noise displaces the points of a cloud across a surface: by these deviations planes are
/// fit, compared and assigned.
///
/// Noise acts along the rays, so that at oblique incidence its component across the surface is
/// small; where no view point is known, it is the same in all directions. No surface is an exact
/// plane, and no ray exactly known: the variance along the ray is that of the noise, of a flatness
/// of 2 mm and of the rounding of the coordinates, and across a surface the deviation is at least a
/// third of that along the ray.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// A point is an inlier of a plane up to this many standard deviations: 99.7 % of a normal
/// distribution.
inline constexpr double most_deviations = 3.0;

/// Beyond this many it is an outlier whatever the other points are: the 99.99994 % quantile.
inline constexpr double certain_deviations = 5.0;

inline constexpr double flatness = 0.002;  // [m]; chosen: of walls and furniture
/// Of the angle of incidence: three deviations are at least the noise along the ray.
inline constexpr double least_cosine = 1.0 / most_deviations;  // formula
/// The angle between a ray and a surface below which the surface was not seen: planes of less are
/// those of scan lines, which contain their view point.
inline constexpr angle edge_on = degrees(1);  // chosen

/// The noise of one point: its standard deviation along the ray [m], and the direction of the ray,
/// which is zero where it is not known.
struct point_noise {
    double sigma;
    Eigen::Vector3d ray;

    /// @param way       from the view point to the point [m]
    /// @param is_seen   whether that is known to be its ray
    /// @param rounding  of its coordinates [m]
    point_noise(const noise_curve& noise, const Eigen::Vector3d& way, bool is_seen, double rounding)
        : point_noise(noise.variance_along(way), way, is_seen, rounding) {}
    /// @param variance  along the ray [m^2]
    point_noise(double variance, const Eigen::Vector3d& way, bool is_seen, double rounding)
        : sigma(std::sqrt(flatness * flatness + rounding * rounding + variance)),
          ray(0.0, 0.0, 0.0) {
        if (is_seen && has_length(way)) ray = direction_of(way);
    }

    /// The distance from a plane beyond which the point is certainly not on it [m]: five standard
    /// deviations, and 1 cm as no surface is an exact plane.
    /// @param normal  of unit length
    [[nodiscard]] double certain_reach(const Eigen::Vector3d& normal) const {
        const double noise = std::sqrt(std::max(0.0, sigma * sigma - flatness * flatness));
        return certain_deviations * (noise / sigma * across(normal) + flatness);
    }

    [[nodiscard]] bool has_ray() const { return dot(ray, ray) > 0.0; }

    /// The standard deviation of the point across a plane [m].
    /// @param normal  of unit length
    [[nodiscard]] double across(const Eigen::Vector3d& normal) const {
        return has_ray() ? sigma * std::max(std::abs(dot(normal, ray)), least_cosine) : sigma;
    }
};

/// The noise of a point of an index. The origin stands for an unknown view point.
/// (A template, so that only its users compile it.)
/// @param is_seen  whether the view points are known
[[nodiscard]] point_noise noise_of_point(const auto& index, const noise_curve& noise, std::size_t i,
                                         bool is_seen) {
    const Eigen::Vector3d p = index[i], v = index.viewpoints[i];
    const bool is_known = is_finite(v);
    const double rounding =
        index.epsilon() * std::max({std::abs(p[0]), std::abs(p[1]), std::abs(p[2])});
    return {noise, is_known ? difference(p, v) : p, is_seen && is_known, rounding};
}

/// The noise of all points of an index.
template <execution X>
[[nodiscard]] scratch<point_noise> noise_of_points(const spatial_index& index,
                                                   const noise_curve& noise, const X& run,
                                                   bool is_seen) {
    scratch<point_noise> all(index.size(), point_noise(noise, {0.0, 0.0, 0.0}, false, 0.0));
    for_each_chunk(run, index.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (index.is_finite(i)) all[i] = noise_of_point(index, noise, i, is_seen);
    });
    return all;
}

}  // namespace gnomon::detail
