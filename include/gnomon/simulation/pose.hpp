// SPDX-License-Identifier: BSL-1.0
/// @file
/// Poses: rigid motions from a local frame to an outer frame.
#pragma once

#include <gnomon/core/angle.hpp>
#include <gnomon/core/rigid_motion.hpp>

namespace gnomon::simulation {

/// A rigid motion: the point x of the local frame is rotation * x + position in the outer frame.
/// Frames: x forward, y left, z up.
using pose = rigid_motion;

/// The translation to (x, y, z) [m].
[[nodiscard]] inline pose at(double x, double y, double z) {
    pose result;
    result.position = Eigen::Vector3d(x, y, z);
    return result;
}

namespace detail {

/// The right-handed rotation from axis i towards axis j.
[[nodiscard]] inline pose turn(int i, int j, angle a) {
    pose result;
    result.rotation(i, i) = result.rotation(j, j) = cos(a);
    result.rotation(j, i) = sin(a);
    result.rotation(i, j) = -sin(a);
    return result;
}

}  // namespace detail

/// The rotation about x; positive angles raise the left side.
[[nodiscard]] inline pose roll(angle a) { return detail::turn(1, 2, a); }
/// The rotation about y; positive angles lower the forward axis x.
[[nodiscard]] inline pose pitch(angle a) { return detail::turn(2, 0, a); }
/// The rotation about z; positive angles turn to the left.
[[nodiscard]] inline pose yaw(angle a) { return detail::turn(0, 1, a); }

}  // namespace gnomon::simulation
