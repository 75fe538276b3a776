// SPDX-License-Identifier: BSL-1.0
/// @file
/// The direction of the scan line through a ray, from the rays around it: neither the number of a
/// beam nor the axis of the sensor is required.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>

namespace gnomon::detail {

/// Where other rays are around one ray, in the plane across it. (A template, as the next, for
/// compile time only.)
template <class Vector = Eigen::Vector3d>
class ray_plane {
  public:
    /// @param u  the direction of the ray, of unit length
    explicit ray_plane(const Vector& u) : right_(orthogonal(u)), up_(cross(u, right_)) {}

    /// The two coordinates of a direction [rad], for unit vectors near the ray.
    [[nodiscard]] std::array<double, 2> offset(const Vector& direction) const {
        return {dot(direction, right_), dot(direction, up_)};
    }

  private:
    Vector right_, up_;
};

/// The axis through a ray that most of the rays around it are near. Angles are doubled, so that
/// both ends of the axis are one.
template <class Number = double>
class scan_line {
  public:
    /// Adds another ray.
    void add(const std::array<Number, 2>& offset, double weight = 1.0) {
        const auto [x, y] = offset;
        const double squared = x * x + y * y;
        if (!(squared > 0.0)) return;
        const double factor = weight / squared;
        cosines_ += in_steps(factor * (x * x - y * y));
        sines_ += in_steps(factor * 2.0 * x * y);
    }

    /// Fits the axis to the rays.
    void fit() {
        const double size = std::sqrt(cosines_ * cosines_ + sines_ * sines_);
        if (!(size > 0.0)) return;
        cosines_ /= size;
        sines_ /= size;
        turn_ = {std::sqrt(0.5 + 0.5 * cosines_),
                 std::copysign(std::sqrt(0.5 - 0.5 * cosines_), sines_)};
    }

    /// Whether a ray is within 45 degrees of the axis. After fit(). The cosine of the doubled angle
    /// decides; at 45 degrees, where rays on a grid often are, rounding does not.
    [[nodiscard]] bool is_along(const std::array<Number, 2>& offset) const {
        const auto [x, y] = offset;
        constexpr double rounding = 1e-6;  // of 1, the cosine; numerical
        return cosines_ * (x * x - y * y) + sines_ * 2.0 * x * y >= -rounding * (x * x + y * y);
    }

    /// Which of the four quadrants a ray is in: 0 and 1 along the axis, 2 and 3 across it. After
    /// fit().
    [[nodiscard]] std::size_t quadrant(const std::array<Number, 2>& offset) const {
        const double along = turn_[0] * offset[0] + turn_[1] * offset[1];
        const double across = turn_[0] * offset[1] - turn_[1] * offset[0];
        return is_along(offset) ? (along < 0.0 ? 1 : 0) : (across < 0.0 ? 3 : 2);
    }

  private:
    /// Rounded to multiples of 2^-40: sums of thousands of cosines are exact, in whatever order.
    [[nodiscard]] static double in_steps(double x) {
        constexpr double rounder = 1.5 * 4096.0;  // has a last place of 2^-40
        return (x + rounder) - rounder;
    }

    double cosines_ = 0.0, sines_ = 0.0;    // of twice the angle
    std::array<Number, 2> turn_{1.0, 0.0};  // the axis
};

}  // namespace gnomon::detail
