// SPDX-License-Identifier: BSL-1.0
/// @file
/// A wall of a room. No object stands in it: an object that is in front of a wall, and in part
/// behind it, is not there.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/plane.hpp>

namespace gnomon::recognition {

/// A part of a plane, with objects on the side of its normal only.
struct wall {
    plane surface;        ///< with its normal towards the sensor
    oriented_box extent;  ///< of the points on it [m]

    /// Whether a place is behind the wall, hidden by it.
    /// @param at         [m]
    /// @param viewpoint  [m]
    /// @param range      observed from there towards the place [m]; negative if nothing was
    /// @param tolerance  of distances from the wall [m]
    [[nodiscard]] bool hides(const Eigen::Vector3d& at, const Eigen::Vector3d& viewpoint,
                             double range, double tolerance) const {
        if (!(surface.signed_distance(at) < -tolerance)) return false;
        const Eigen::Vector3d way = gnomon::detail::difference(at, viewpoint);
        const double distance = gnomon::detail::length(way);
        if (!(range >= 0.0 && range < distance)) return false;
        const Eigen::Vector3d hit = gnomon::detail::combined(1.0, viewpoint, range / distance, way);
        oriented_box around = extent;
        around.lengths += Eigen::Vector3d::Constant(2.0 * tolerance);
        return std::abs(surface.signed_distance(hit)) <= tolerance && around.contains(hit);
    }
};

}  // namespace gnomon::recognition
