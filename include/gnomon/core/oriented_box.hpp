// SPDX-License-Identifier: BSL-1.0
/// @file
/// A box of any orientation.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// A box with edges along three orthonormal axes. A rectangle is a box whose last length is zero; a
/// box without any point has all members at their defaults.
struct oriented_box {
    Eigen::Vector3d center{0.0, 0.0, 0.0};                   ///< [m]
    Eigen::Matrix3d axes = detail::diagonal(1.0, 1.0, 1.0);  ///< unit columns
    Eigen::Vector3d lengths{0.0, 0.0, 0.0};  ///< of the edges along them [m]; may be infinite

    /// [m^3]
    [[nodiscard]] double volume() const { return lengths[0] * lengths[1] * lengths[2]; }

    /// Whether the point x [m] is in the box or on its surface, up to rounding; false for NaN.
    [[nodiscard]] bool contains(const Eigen::Vector3d& x) const {
        const Eigen::Vector3d offset = detail::difference(x, center);
        for (int a = 0; a < 3; ++a)
            if (!(2.0 * std::abs(detail::dot(detail::column(axes, a), offset)) <= lengths[a]))
                return false;
        return true;
    }
};

namespace detail {

/// @throws std::invalid_argument  unless the center is finite, no length is negative or NaN, and
///                                the axes are orthonormal
inline void require_valid(const oriented_box& box) {
    constexpr double rounding = 1e-6;  // numerical
    require(all_finite(box.center), "oriented_box: the center must be finite");
    for (int a = 0; a < 3; ++a) {
        require(box.lengths[a] >= 0.0, "oriented_box: a length must not be negative or NaN");
        for (int b = a; b < 3; ++b) {
            const double product = dot(column(box.axes, a), column(box.axes, b));
            require(std::abs(product - (a == b ? 1.0 : 0.0)) < rounding,
                    "oriented_box: the axes must be orthonormal");
        }
    }
}

}  // namespace detail
}  // namespace gnomon
