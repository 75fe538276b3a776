// SPDX-License-Identifier: BSL-1.0
/// @file
/// Poses: rigid motions from a local frame to an outer frame.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::simulation {

/// A rigid motion: the point x of the local frame is rotation * x + position in the outer frame.
/// Frames: x forward, y left, z up.
struct pose {
    /// From the object's frame to the world's.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]

    /// A direction of the local frame, expressed in the outer frame.
    [[nodiscard]] Eigen::Vector3d direction_out(const Eigen::Vector3d& v) const {
        return {rotation(0, 0) * v.x() + rotation(0, 1) * v.y() + rotation(0, 2) * v.z(),
                rotation(1, 0) * v.x() + rotation(1, 1) * v.y() + rotation(1, 2) * v.z(),
                rotation(2, 0) * v.x() + rotation(2, 1) * v.y() + rotation(2, 2) * v.z()};
    }
    /// A direction of the outer frame, expressed in the local frame.
    [[nodiscard]] Eigen::Vector3d direction_in(const Eigen::Vector3d& v) const {
        return {rotation(0, 0) * v.x() + rotation(1, 0) * v.y() + rotation(2, 0) * v.z(),
                rotation(0, 1) * v.x() + rotation(1, 1) * v.y() + rotation(2, 1) * v.z(),
                rotation(0, 2) * v.x() + rotation(1, 2) * v.y() + rotation(2, 2) * v.z()};
    }
    /// A point of the local frame, expressed in the outer frame [m].
    [[nodiscard]] Eigen::Vector3d point_out(const Eigen::Vector3d& p) const {
        return direction_out(p) + position;
    }
    /// A point of the outer frame, expressed in the local frame [m].
    [[nodiscard]] Eigen::Vector3d point_in(const Eigen::Vector3d& p) const {
        return direction_in(p - position);
    }

    /// The composition of two poses: `inner` is given in the local frame of this pose.
    [[nodiscard]] pose operator*(const pose& inner) const {
        pose result;
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d column =
                direction_out({inner.rotation(0, j), inner.rotation(1, j), inner.rotation(2, j)});
            for (int i = 0; i < 3; ++i) result.rotation(i, j) = column[i];
        }
        result.position = point_out(inner.position);
        return result;
    }
};

/// The translation to (x, y, z) [m].
[[nodiscard]] inline pose at(double x, double y, double z) {
    pose result;
    result.position = Eigen::Vector3d(x, y, z);
    return result;
}

/// Returns whether a pose is a rigid motion: finite, with orthonormal, right-handed axes, to a
/// tolerance of 1e-9.
[[nodiscard]] inline bool is_rigid(const pose& p) {
    constexpr double tolerance = 1e-9;
    const auto& m = p.rotation;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double product = m(i, 0) * m(j, 0) + m(i, 1) * m(j, 1) + m(i, 2) * m(j, 2);
            if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < tolerance)) return false;
        }
    }
    // The determinant of orthonormal axes is 1, or -1 if they are left-handed.
    const double determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) +
                               m(0, 1) * (m(1, 2) * m(2, 0) - m(1, 0) * m(2, 2)) +
                               m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
    return determinant > 0.0 && is_finite(p.position);
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
