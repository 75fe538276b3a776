// SPDX-License-Identifier: BSL-1.0
/// @file
/// Rays and their hits.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace gnomon::simulation {

/// A ray: the points origin + t * direction with 0 < t <= reach.
struct ray {
    Eigen::Vector3d origin;                                  ///< [m]
    Eigen::Vector3d direction;                               ///< unit length
    double reach = std::numeric_limits<double>::infinity();  ///< [m]

    /// The point at a range [m].
    [[nodiscard]] Eigen::Vector3d point_at(double range) const {
        return origin + direction * range;
    }
};

/// The first intersection of a ray with a surface.
struct ray_hit {
    double range;            ///< from the ray's origin [m]
    Eigen::Vector3d normal;  ///< unit length, on the side that the ray comes from
    std::int32_t surface;    ///< number of the surface, within the shape or the scene
};

}  // namespace gnomon::simulation
