// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where something is and how it is turned: a rigid motion from its own frame to the world's.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon {

/// x in the own frame is rotation x + position in the outer one. Frames: x forward, y left, z up.
struct pose {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]

    /// A direction of the own frame, in the outer one.
    [[nodiscard]] Eigen::Vector3d direction_out(const Eigen::Vector3d& v) const {
        return {rotation(0, 0) * v.x() + rotation(0, 1) * v.y() + rotation(0, 2) * v.z(),
                rotation(1, 0) * v.x() + rotation(1, 1) * v.y() + rotation(1, 2) * v.z(),
                rotation(2, 0) * v.x() + rotation(2, 1) * v.y() + rotation(2, 2) * v.z()};
    }
    /// A direction of the outer frame, in the own one.
    [[nodiscard]] Eigen::Vector3d direction_in(const Eigen::Vector3d& v) const {
        return {rotation(0, 0) * v.x() + rotation(1, 0) * v.y() + rotation(2, 0) * v.z(),
                rotation(0, 1) * v.x() + rotation(1, 1) * v.y() + rotation(2, 1) * v.z(),
                rotation(0, 2) * v.x() + rotation(1, 2) * v.y() + rotation(2, 2) * v.z()};
    }
    /// A point of the own frame, in the outer one [m].
    [[nodiscard]] Eigen::Vector3d point_out(const Eigen::Vector3d& p) const {
        return direction_out(p) + position;
    }
    /// A point of the outer frame, in the own one [m].
    [[nodiscard]] Eigen::Vector3d point_in(const Eigen::Vector3d& p) const {
        return direction_in(p - position);
    }

    /// `inner`, given in the frame of this pose, in the outer frame.
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

/// At (x, y, z) [m], not turned.
[[nodiscard]] inline pose at(double x, double y, double z) {
    pose result;
    result.position = Eigen::Vector3d(x, y, z);
    return result;
}

/// Whether a pose is a rigid motion: finite, its axes of unit length, at right angles and
/// right-handed, all to 1e-9.
[[nodiscard]] inline bool is_rigid(const pose& p) {
    constexpr double tolerance = 1e-9;
    const auto& m = p.rotation;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j <= i; ++j) {
            const double product = m(i, 0) * m(j, 0) + m(i, 1) * m(j, 1) + m(i, 2) * m(j, 2);
            if (!(std::abs(product - (i == j ? 1.0 : 0.0)) < tolerance)) return false;
        }
    }
    // Of orthonormal axes the determinant is 1, or -1 if they are mirrored.
    const double determinant = m(0, 0) * (m(1, 1) * m(2, 2) - m(1, 2) * m(2, 1)) +
                               m(0, 1) * (m(1, 2) * m(2, 0) - m(1, 0) * m(2, 2)) +
                               m(0, 2) * (m(1, 0) * m(2, 1) - m(1, 1) * m(2, 0));
    return determinant > 0.0 && is_finite(p.position);
}

namespace detail {

/// A right-handed turn in the plane from axis i to axis j.
[[nodiscard]] inline pose turn(int i, int j, angle a) {
    pose result;
    result.rotation(i, i) = result.rotation(j, j) = cos(a);
    result.rotation(j, i) = sin(a);
    result.rotation(i, j) = -sin(a);
    return result;
}

}  // namespace detail

/// Turned about x: the left side up.
[[nodiscard]] inline pose roll(angle a) { return detail::turn(1, 2, a); }
/// Turned about y: x, what looks forward, down.
[[nodiscard]] inline pose pitch(angle a) { return detail::turn(2, 0, a); }
/// Turned about z: to the left.
[[nodiscard]] inline pose yaw(angle a) { return detail::turn(0, 1, a); }

}  // namespace gnomon
