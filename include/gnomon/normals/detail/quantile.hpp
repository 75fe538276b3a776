// SPDX-License-Identifier: BSL-1.0
/// @file
/// Quantiles of a sample, in linear time.
#pragma once

#include <algorithm>
#include <cstddef>

namespace gnomon::detail {

/// The element that the given part of the values is less than. Precondition: there are values, and
/// `part` is under 1. Changes their order.
[[nodiscard]] double quantile(auto& values, double part) {
    const auto rank = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size()));
    std::nth_element(values.begin(), values.begin() + rank, values.end());
    return values[static_cast<std::size_t>(rank)];
}

}  // namespace gnomon::detail
