// SPDX-License-Identifier: BSL-1.0
/// @file
/// The measurement function of the filters of planes: the range at which a ray meets the plane
/// n . (x - c) = distance, and its gradient with respect to n, which may have any length.
///
/// Klasing 2010, Sec. 3.2.7, Eqs. (3.17) and (3.18), where the distance is zero.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>

namespace gnomon::detail {

/// h(n), Eq. (3.17): the range [m] along the unit ray u.
[[nodiscard]] inline double range_of_plane(const Eigen::Vector3d& c, const Eigen::Vector3d& n,
                                           const Eigen::Vector3d& u, double distance = 0.0) {
    return (dot(c, n) + distance) / dot(u, n);
}

/// dh/dn, Eq. (3.18).
[[nodiscard]] inline Eigen::Vector3d range_gradient(const Eigen::Vector3d& c,
                                                    const Eigen::Vector3d& n,
                                                    const Eigen::Vector3d& u,
                                                    double distance = 0.0) {
    const double un = dot(u, n);
    return combined(1.0 / un, c, -(dot(c, n) + distance) / (un * un), u);
}

}  // namespace gnomon::detail
