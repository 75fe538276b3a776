// SPDX-License-Identifier: BSL-1.0
/// @file
/// The tail of the normal distribution, and the p-value of the Anderson-Darling statistic.
#pragma once

#include <algorithm>
#include <numbers>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::recognition::detail {

/// The logarithm of the probability that a standard normal variable exceeds z, with all digits for
/// every finite z.
[[nodiscard]] inline double log_normal_tail(double z) {
    constexpr double distant = 35.0;  // numerical: erfc underflows at 38
    const double half = 0.5 * std::erfc(std::abs(z) / std::numbers::sqrt2);
    if (z < 0.0) return std::log1p(-half);
    if (z < distant) return std::log(half);
    // The asymptotic series of Abramowitz and Stegun 1964, 26.2.12: its first term left out is
    // below 1e-12.
    const double s = 1.0 / (z * z);
    const double series = 1.0 - s * (1.0 - 3.0 * s * (1.0 - 5.0 * s * (1.0 - 7.0 * s)));
    return -0.5 * z * z - std::log(z) - 0.5 * std::log(2.0 * std::numbers::pi) + std::log(series);
}

/// The p-value of A^2 corrected for the number of values. Formulas of Stephens 1986, Table 4.9,
/// which hold up to A^2 = 10.
[[nodiscard]] inline double anderson_darling_p_value(double a) {
    if (a < 0.2) return 1.0 - std::exp(-13.436 + a * (101.14 - a * 223.73));
    if (a < 0.34) return 1.0 - std::exp(-8.318 + a * (42.796 - a * 59.938));
    if (a < 0.6) return std::exp(0.9177 - a * (4.279 + a * 1.38));
    constexpr double largest = 10.0;  // Stephens 1986
    a = std::min(a, largest);
    return std::exp(1.2937 - a * (5.709 - a * 0.0186));
}

}  // namespace gnomon::recognition::detail
