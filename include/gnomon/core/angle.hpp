// SPDX-License-Identifier: BSL-1.0
/// @file
/// An angle that knows its unit: `degrees(5)` and `radians(0.087)` make one, a bare
/// number does not, so that a threshold is never read in the wrong unit.
#pragma once

#include <algorithm>
#include <compare>
#include <numbers>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// A plane angle, stored in [rad].
class angle {
  public:
    constexpr angle() = default;

    /// [rad]
    [[nodiscard]] constexpr double radians() const { return radians_; }
    /// [deg]
    [[nodiscard]] constexpr double degrees() const { return radians_ * 180.0 / std::numbers::pi; }

    friend constexpr auto operator<=>(const angle&, const angle&) = default;
    friend constexpr angle radians(double value);

  private:
    double radians_ = 0.0;
};

/// The angle of `value` [rad].
[[nodiscard]] constexpr angle radians(double value) {
    angle a;
    a.radians_ = value;
    return a;
}

/// The angle of `value` [deg].
[[nodiscard]] constexpr angle degrees(double value) {
    return radians(value * std::numbers::pi / 180.0);
}

[[nodiscard]] inline double cos(angle a) { return std::cos(a.radians()); }
[[nodiscard]] inline double sin(angle a) { return std::sin(a.radians()); }

namespace detail {

/// The cosine that directions at most `a` apart reach, rounding allowed for.
/// @throws std::invalid_argument  unless `a` lies between 0 and 90 degrees
[[nodiscard]] inline double min_cosine(angle a) {
    require(a >= degrees(0) && a <= degrees(90), "an angle must lie between 0 and 90 degrees");
    return std::max(0.0, cos(a) - 1e-15);
}

}  // namespace detail

}  // namespace gnomon
