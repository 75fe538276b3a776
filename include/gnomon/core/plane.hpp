// SPDX-License-Identifier: BSL-1.0
/// @file
/// A plane in Hesse normal form.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>

namespace gnomon {

/// The points x with normal . x = offset.
struct plane {
    Eigen::Vector3d normal{0.0, 0.0, 1.0};  ///< unit length
    double offset = 0.0;                    ///< [m]

    /// Distance [m] of x from the plane, positive on the normal's side.
    [[nodiscard]] double signed_distance(const Eigen::Vector3d& x) const {
        return detail::dot(normal, x) - offset;
    }
};

}  // namespace gnomon
