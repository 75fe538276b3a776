// SPDX-License-Identifier: BSL-1.0
/// @file
/// Levels a scan: the rigid motion that lays its floor into z = 0. Klasing 2010, Sec. 4.2.2.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>

namespace gnomon {

/// A rigid motion after which the floor is the plane z = 0.
struct leveling {
    Eigen::Matrix3d rotation = detail::diagonal(1.0, 1.0, 1.0);  ///< so that the floor is level
    double lift = 0.0;  ///< added to z after the rotation [m]

    /// The point, turned and moved.
    [[nodiscard]] Eigen::Vector3d operator()(const Eigen::Vector3d& p) const {
        Eigen::Vector3d q = detail::product(rotation, p);
        q[2] += lift;
        return q;
    }

    /// Turns the floor's normal to z by the smallest rotation and lays the floor into z = 0.
    /// @throws std::invalid_argument  unless the floor's normal is of unit length and its
    ///                                offset finite
    [[nodiscard]] static leveling of(const plane& floor) {
        detail::require_hesse(floor);
        const Eigen::Vector3d& n = floor.normal;
        leveling level;
        level.lift = -floor.offset;
        Eigen::Matrix3d& r = level.rotation;
        // 1 + n_z, without cancellation where the scan is nearly upside down.
        const double across = n[0] * n[0] + n[1] * n[1];
        const double h = n[2] >= 0.0 ? 1.0 + n[2] : across / (1.0 - n[2]);
        if (!(h > 0.0)) {  // upside down: half a turn about x
            r(1, 1) = r(2, 2) = -1.0;
            return level;
        }
        // Rodrigues' formula for the rotation about n x z.
        for (int i = 0; i < 2; ++i) {
            for (int j = 0; j < 2; ++j) r(i, j) -= n[i] * n[j] / h;
            r(i, 2) = -n[i];
            r(2, i) = n[i];
        }
        r(2, 2) = n[2];
        return level;
    }
};

}  // namespace gnomon
