// SPDX-License-Identifier: BSL-1.0
/// @file
/// A plane in Hesse normal form.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// The plane of all points x with normal . x = offset. PCL's coefficients (a, b, c, d) are
/// (normal, -offset).
struct plane {
    Eigen::Vector3d normal{0.0, 0.0, 1.0};  ///< unit length
    double offset = 0.0;  ///< signed distance of the plane from the origin along the normal [m]

    /// The distance [m] of the point x [m] from the plane, positive on the side of the normal.
    [[nodiscard]] double signed_distance(const Eigen::Vector3d& x) const {
        return detail::dot(normal, x) - offset;
    }
};

namespace detail {

/// @throws std::invalid_argument  unless the plane is in Hesse normal form
inline void require_hesse(
    const plane& p,
    const char* message =
        "a plane, or a direction upwards, needs a normal of unit length and a finite offset") {
    constexpr double rounding = 1e-6;  // numerical
    require(std::abs(dot(p.normal, p.normal) - 1.0) < rounding && std::isfinite(p.offset), message);
}

}  // namespace detail
}  // namespace gnomon
