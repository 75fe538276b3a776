// SPDX-License-Identifier: BSL-1.0
/// @file
/// Rigid motions: the pose of a sensor, of a scan in a map, or of an object in a room.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon {

/// A rigid motion from a local frame to an outer frame: the point x of the local frame is
/// rotation * x + position in the outer frame.
struct rigid_motion {
    /// From the local frame to the outer one.
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< of the local frame [m]

    /// The motion of a frame that stands on the ground, the plane z = 0: at (x, y) [m], turned to
    /// the left by `yaw`.
    [[nodiscard]] static rigid_motion on_ground(double x, double y, angle yaw) {
        rigid_motion m;
        m.rotation(0, 0) = m.rotation(1, 1) = cos(yaw);
        m.rotation(1, 0) = sin(yaw);
        m.rotation(0, 1) = -sin(yaw);
        m.position = {x, y, 0.0};
        return m;
    }

    /// A direction of the local frame, expressed in the outer frame.
    [[nodiscard]] Eigen::Vector3d direction_out(const Eigen::Vector3d& v) const {
        return detail::product(rotation, v);
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

    /// The motion from the outer frame to the local one.
    [[nodiscard]] rigid_motion inverse() const {
        rigid_motion m;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) m.rotation(i, j) = rotation(j, i);
        m.position = detail::scaled(-1.0, direction_in(position));
        return m;
    }

    /// The composition of two motions: `inner` is given in the local frame of this one.
    [[nodiscard]] rigid_motion operator*(const rigid_motion& inner) const {
        rigid_motion result;
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d column = direction_out(detail::column(inner.rotation, j));
            for (int i = 0; i < 3; ++i) result.rotation(i, j) = column[i];
        }
        result.position = point_out(inner.position);
        return result;
    }
};

/// Returns whether a motion is rigid: finite, with orthonormal, right-handed axes, to a tolerance
/// of 1e-9.
[[nodiscard]] inline bool is_rigid(const rigid_motion& p) {
    constexpr double tolerance = 1e-9;  // numerical: without unit
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

}  // namespace gnomon
