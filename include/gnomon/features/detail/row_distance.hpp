// SPDX-License-Identifier: BSL-1.0
/// @file
/// Distances between descriptors.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::detail {

/// The Euclidean distance. O(n). Precondition: both have n entries.
[[nodiscard]] double euclidean_distance(const auto& a, const auto& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        squares += difference * difference;
    }
    return std::sqrt(squares);
}

/// 1 - R in [0, 2], where R is the coefficient of linear correlation of the entries. If one of
/// them is constant, R is undefined: the result is 0 for equal entries, else 1. O(n).
/// Precondition: both have n entries.
[[nodiscard]] inline double correlation_distance(std::span<const float> a,
                                                 std::span<const float> b) {
    if (std::equal(a.begin(), a.end(), b.begin())) return 0.0;
    double mean_a = 0.0, mean_b = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        mean_a += static_cast<double>(a[i]);
        mean_b += static_cast<double>(b[i]);
    }
    mean_a /= static_cast<double>(a.size());
    mean_b /= static_cast<double>(a.size());
    double aa = 0.0, ab = 0.0, bb = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = static_cast<double>(a[i]) - mean_a;
        const double y = static_cast<double>(b[i]) - mean_b;
        aa += x * x;
        ab += x * y;
        bb += y * y;
    }
    const double size = std::sqrt(aa) * std::sqrt(bb);
    return size > 0.0 ? 1.0 - std::clamp(ab / size, -1.0, 1.0) : 1.0;
}

}  // namespace gnomon::detail
