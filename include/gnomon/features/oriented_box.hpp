// SPDX-License-Identifier: BSL-1.0
/// @file
/// A box of any orientation.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>

namespace gnomon {

/// A box with edges along three orthonormal, right-handed axes. A rectangle is a box whose last
/// length is zero; a box without any point has all members at their defaults.
struct oriented_box {
    Eigen::Vector3d center{0.0, 0.0, 0.0};                   ///< [m]
    Eigen::Matrix3d axes = detail::diagonal(1.0, 1.0, 1.0);  ///< unit columns
    Eigen::Vector3d lengths{0.0, 0.0, 0.0};                  ///< of the edges along them [m]

    /// The volume of the box [m^3].
    [[nodiscard]] double volume() const { return lengths[0] * lengths[1] * lengths[2]; }
};

}  // namespace gnomon
