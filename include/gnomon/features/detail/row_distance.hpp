// SPDX-License-Identifier: BSL-1.0
/// @file
/// Distances between descriptors, and the limit of their lengths.
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <span>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::detail {

/// Whether the product of some numbers is that of the entries of a descriptor: not 0, and without
/// overflow at most 2^20.
[[nodiscard]] inline bool is_row_length(std::initializer_list<std::size_t> factors) {
    constexpr std::size_t most = std::size_t{1} << 20;  // chosen: 4 MiB of floats, against mistakes
    std::size_t entries = 1;
    for (const std::size_t f : factors) {
        if (f == 0 || f > most / entries) return false;
        entries *= f;
    }
    return true;
}

/// @throws std::invalid_argument  if two descriptors have different numbers of entries
inline void require_equal_length(const auto& a, const auto& b) {
    require(a.size() == b.size(), "descriptor: rows of different lengths have no distance");
}

/// The Euclidean distance. O(n) for n entries.
/// @throws std::invalid_argument  if the numbers of entries differ
[[nodiscard]] double euclidean_distance(const auto& a, const auto& b) {
    require_equal_length(a, b);
    double squares = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        squares += difference * difference;
    }
    return std::sqrt(squares);
}

/// 1 - R in [0, 2], where R is the coefficient of linear correlation of the entries. If one of
/// them is constant, R is undefined: the result is 0 for equal entries, else 1. O(n)
/// for n entries.
/// @throws std::invalid_argument  if the numbers of entries differ
[[nodiscard]] inline double correlation_distance(std::span<const float> a,
                                                 std::span<const float> b) {
    require_equal_length(a, b);
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
