// SPDX-License-Identifier: BSL-1.0
/// @file
/// An angle with an explicit unit: `degrees(5)` and `radians(0.087)` construct one. A number
/// without a unit is refused, so that no threshold is read in the wrong unit.
#pragma once

#include <algorithm>
#include <compare>
#include <numbers>
#include <type_traits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon {

/// A plane angle, stored in [rad].
class angle {
  public:
    constexpr angle() = default;

    // A number has no unit. Compilers print the remedy: g++ the name of the template parameter,
    // clang the reason.
#ifdef __clang__
    template <class Number>
        requires std::is_arithmetic_v<Number>
    [[clang::unavailable("write degrees(5) or radians(0.087)")]] angle(Number);
#else
    template <class write_degrees_or_radians>
        requires std::is_arithmetic_v<write_degrees_or_radians>
    angle(write_degrees_or_radians) = delete;
#endif

    /// [rad]
    [[nodiscard]] constexpr double radians() const { return radians_; }
    /// [deg]
    [[nodiscard]] constexpr double degrees() const { return radians_ * 180.0 / std::numbers::pi; }

    friend constexpr auto operator<=>(const angle&, const angle&) = default;
    friend constexpr angle radians(double value);

    [[nodiscard]] friend double cos(angle a) { return std::cos(a.radians_); }  ///< its cosine
    [[nodiscard]] friend double sin(angle a) { return std::sin(a.radians_); }  ///< its sine

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

namespace detail {

/// The smallest cosine between two directions whose angle is at most `a`, less a margin for
/// rounding.
/// @throws std::invalid_argument  unless `a` lies between 0 and 90 degrees
[[nodiscard]] inline double min_cosine(angle a) {
    require(a >= degrees(0) && a <= degrees(90), "an angle must lie between 0 and 90 degrees");
    return std::max(0.0, cos(a) - 1e-15);
}

}  // namespace detail

}  // namespace gnomon
