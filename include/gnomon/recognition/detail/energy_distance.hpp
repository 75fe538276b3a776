// SPDX-License-Identifier: BSL-1.0
/// @file
/// The energy distance between samples and the standard normal distribution (Szekely and Rizzo
/// 2005).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/recognition/detail/chi_squared.hpp>

namespace gnomon::recognition::detail {

/// E|Z| of a standard normal vector of D components.
template <std::size_t D>
[[nodiscard]] double mean_length() {
    return std::numbers::sqrt2 * std::exp(log_gamma_of_half(D + 1) - log_gamma_of_half(D));
}

/// E|a - Z|, the mean of the noncentral chi distribution, for a vector of squared length `squared`.
///
/// With x = |a|^2 / 2 it is E|Z| M(-1/2, D/2, -x), Kummer's function. For moderate x by Kummer's
/// transformation, E|Z| e^-x M((D + 1)/2, D/2, x), whose terms are all positive; for large x by the
/// asymptotic series |a| sum_k (-1/2)_k ((1 - D)/2)_k / (k! x^k) (Abramowitz and Stegun 1964,
/// 13.1.27 and 13.5.1).
template <std::size_t D>
[[nodiscard]] double mean_distance_to_normal(double squared, double mean_length) {
    constexpr auto d = static_cast<double>(D);
    constexpr double distant = std::min(50.0 + d * d, 500.0);  // numerical: e^x does not overflow
    constexpr int most = 1000;                                 // never reached
    constexpr double eps = std::numeric_limits<double>::epsilon();
    const double x = 0.5 * squared;
    double term = 1.0, sum = 1.0;
    if (x < distant) {
        for (int k = 0; k < most && (term > eps * sum || k < x); ++k) {
            term *= x * (0.5 * (d + 1.0) + k) / ((0.5 * d + k) * (k + 1.0));
            sum += term;
        }
        return mean_length * std::exp(-x) * sum;
    }
    for (int k = 0; k < most && std::abs(term) > eps * sum; ++k) {
        const double next = term * (k - 0.5) * (k + 0.5 * (1.0 - d)) / ((k + 1.0) * x);
        if (std::abs(next) > std::abs(term)) break;  // the series is asymptotic
        sum += term = next;
    }
    return std::sqrt(squared) * sum;
}

/// n (2 E|Y - Z| - E|Z - Z'| - E|Y - Y'|), where Y is one of the n samples. O(n^2 D).
template <std::size_t D>
[[nodiscard]] double energy_of_standardized(const std::vector<std::array<double, D>>& y) {
    const auto n = static_cast<double>(y.size());
    const double length = mean_length<D>();
    double to_normal = 0.0, to_others = 0.0;
    for (std::size_t i = 0; i < y.size(); ++i) {
        double squared = 0.0;
        for (const double value : y[i]) squared += value * value;
        to_normal += mean_distance_to_normal<D>(squared, length);
        double row = 0.0;
        for (std::size_t j = 0; j < i; ++j) {
            double between = 0.0;
            for (std::size_t m = 0; m < D; ++m)
                between += (y[i][m] - y[j][m]) * (y[i][m] - y[j][m]);
            row += std::sqrt(between);
        }
        to_others += row;
    }
    return 2.0 * to_normal - n * std::numbers::sqrt2 * length - 2.0 * to_others / n;
}

}  // namespace gnomon::recognition::detail
