// SPDX-License-Identifier: BSL-1.0
/// @file
/// What light does in this floor: it leaves a place in a direction, and a surface stops it.
#pragma once

#include <cstdint>
#include <limits>

#include <Eigen/Core>

namespace gnomon {

/// All points origin + t direction with 0 < t <= reach.
struct ray {
    Eigen::Vector3d origin;                                  ///< [m]
    Eigen::Vector3d direction;                               ///< unit length
    double reach = std::numeric_limits<double>::infinity();  ///< [m]

    [[nodiscard]] Eigen::Vector3d point_at(double range) const {
        return origin + direction * range;
    }
};

/// Where a ray first meets a surface.
struct ray_hit {
    double range;            ///< from the ray's origin [m]
    Eigen::Vector3d normal;  ///< unit length, on the side that the ray comes from
    std::int32_t surface;    ///< number of the surface: of the shape, or of the scene
};

}  // namespace gnomon
