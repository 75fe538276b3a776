// SPDX-License-Identifier: BSL-1.0
/// @file
/// How nearly two flat segments are in one plane.
///
/// Klasing 2010, Sec. 4.3.3, Eq. (4.5) and (4.6), Fig. 4.6. (The coplanar distance, Eq. (4.7), is
/// in boundary_pairs.hpp.)
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace gnomon::detail {

/// rho_a, between the planes [rad], from 0 to pi / 2, Eq. (4.5). Where Fig. 4.6 names the inner
/// product itself, the equation stands.
[[nodiscard]] inline double angular_distance(const principal_frame& a, const principal_frame& b) {
    const Eigen::Vector3d n = a.normal(), m = b.normal();
    // Unlike acos, exact for small angles.
    return std::atan2(length(cross(n, m)), std::abs(dot(n, m)));
}

/// rho_o, the smaller of the distances of each centroid from the other's plane [m], Eq. (4.6).
[[nodiscard]] inline double orthogonal_distance(const principal_frame& a,
                                                const principal_frame& b) {
    const Eigen::Vector3d between = difference(b.centroid, a.centroid);
    return std::min(std::abs(dot(a.normal(), between)), std::abs(dot(b.normal(), between)));
}

}  // namespace gnomon::detail
