// SPDX-License-Identifier: BSL-1.0
/// @file
/// The chi^2 distribution: its tail probability by the regularized incomplete gamma functions
/// (Abramowitz and Stegun 1964, 6.5.29 and 6.5.31), and its quantiles by inverting them.
#pragma once

#include <cstddef>
#include <limits>
#include <numbers>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::recognition::detail {

/// log Gamma(n / 2) for n > 0, by the recurrence from Gamma(1/2) and Gamma(1). (std::lgamma writes
/// to a variable that threads share.) O(n).
[[nodiscard]] inline double log_gamma_of_half(std::size_t n) {
    double sum = n % 2 == 0 ? 0.0 : 0.5 * std::log(std::numbers::pi);
    for (std::size_t i = n % 2 == 0 ? 2 : 1; i < n; i += 2)
        sum += std::log(0.5 * static_cast<double>(i));
    return sum;
}

/// The two regularized incomplete gamma functions, P + Q = 1. The smaller one has all its digits.
struct incomplete_gamma {
    double lower;  ///< P(a, x)
    double upper;  ///< Q(a, x)
};

/// P and Q for a = degrees / 2 and x >= 0: below a + 1 by the power series of P, else by the
/// continued fraction of Q, evaluated by Lentz's method.
[[nodiscard]] inline incomplete_gamma incomplete_gamma_of(std::size_t degrees, double x) {
    if (x == 0.0) return {0.0, 1.0};
    if (std::isinf(x)) return {1.0, 0.0};
    constexpr double eps = std::numeric_limits<double>::epsilon();
    constexpr double tiny = 1e-300;  // numerical: for a denominator of 0
    constexpr int most = 100'000;    // never reached: the number of terms grows as sqrt(a)
    const double a = 0.5 * static_cast<double>(degrees);
    const double factor = std::exp(a * std::log(x) - x - log_gamma_of_half(degrees));
    if (x < a + 1.0) {
        double term = 1.0 / a, sum = term;
        for (int n = 1; n < most && term > eps * sum; ++n) sum += term *= x / (a + n);
        return {factor * sum, 1.0 - factor * sum};
    }
    double b = x + 1.0 - a, c = 1.0 / tiny, d = 1.0 / b, fraction = d;
    for (int n = 1; n < most; ++n) {
        const double numerator = -n * (n - a);
        b += 2.0;
        d = numerator * d + b;
        c = b + numerator / c;
        if (d == 0.0) d = tiny;
        if (c == 0.0) c = tiny;
        d = 1.0 / d;
        fraction *= d * c;
        if (std::abs(d * c - 1.0) <= eps) break;
    }
    return {1.0 - factor * fraction, factor * fraction};
}

/// The probability that a chi^2 variable exceeds x.
/// @param degrees  of freedom, at least 1
[[nodiscard]] inline double chi_squared_tail(double x, std::size_t degrees) {
    return x <= 0.0 ? 1.0 : incomplete_gamma_of(degrees, 0.5 * x).upper;
}

/// The value that a chi^2 variable is below with probability p: the inverse of P(degrees / 2,
/// x / 2), by Newton's method within a bracket. Accurate to 1e-12, relatively, where 1 - p has
/// these digits.
/// @param p        in (0, 1)
/// @param degrees  of freedom, at least 1
/// @throws std::invalid_argument  otherwise
[[nodiscard]] inline double chi_squared_quantile(double p, std::size_t degrees) {
    gnomon::detail::require(p > 0.0 && p < 1.0, "chi_squared_quantile: p must be in (0, 1)");
    gnomon::detail::require(degrees > 0, "chi_squared_quantile: no degrees of freedom");
    const double a = 0.5 * static_cast<double>(degrees), log_gamma = log_gamma_of_half(degrees);
    // The excess over p, from that of the two functions which has its digits.
    const auto excess = [&](double x) {
        const incomplete_gamma g = incomplete_gamma_of(degrees, x);
        return g.lower < 0.5 ? g.lower - p : (1.0 - p) - g.upper;
    };
    double low = 0.0, high = a;
    while (excess(high) < 0.0) {
        low = high;
        high *= 2.0;
    }
    double x = 0.5 * (low + high);
    constexpr int most = 2000;  // bisections of the range of doubles; Newton's method takes ten
    for (int i = 0; i < most; ++i) {
        const double over = excess(x);
        (over < 0.0 ? low : high) = x;
        const double density = std::exp((a - 1.0) * std::log(x) - x - log_gamma);
        double next = x - over / density;
        if (!(next > low && next < high)) next = 0.5 * (low + high);
        const bool is_done = std::abs(next - x) <= 4.0 * std::numeric_limits<double>::epsilon() * x;
        x = next;
        if (is_done) break;
    }
    return 2.0 * x;
}

}  // namespace gnomon::recognition::detail
