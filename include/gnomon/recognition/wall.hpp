// SPDX-License-Identifier: BSL-1.0
/// @file
/// A wall of a room, in which no object stands.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/plane.hpp>

namespace gnomon::recognition {

/// A part of a plane. It may have openings; an object that stands in one of them is not
/// distinguished from one that stands in the wall.
struct wall {
    plane surface;        ///< its normal is towards the view points of most points of the wall
    oriented_box extent;  ///< of the points of the wall [m]

    /// The place on the plane of the wall that is nearest to x [m].
    [[nodiscard]] Eigen::Vector3d foot_of(const Eigen::Vector3d& x) const {
        return gnomon::detail::combined(1.0, x, -surface.signed_distance(x), surface.normal);
    }

    /// Whether x [m] is behind the wall, as seen along its normal.
    /// @param tolerance  x is at least this far behind, and its foot at most this far outside of
    ///                   the extent [m]
    [[nodiscard]] bool is_before(const Eigen::Vector3d& x, double tolerance) const {
        if (!(surface.signed_distance(x) < -tolerance)) return false;
        oriented_box around = extent;
        around.lengths += Eigen::Vector3d::Constant(2.0 * tolerance);
        return around.contains(foot_of(x));
    }
};

}  // namespace gnomon::recognition
