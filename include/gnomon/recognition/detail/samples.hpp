// SPDX-License-Identifier: BSL-1.0
/// @file
/// Samples: rows of D numbers, `std::array<double, D>`, in any contiguous range.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>

namespace gnomon::recognition::detail {

/// The number of values of a sample type; 0 of all other types.
template <class S>
inline constexpr std::size_t length_of_sample = 0;
template <std::size_t D>
inline constexpr std::size_t length_of_sample<std::array<double, D>> = D;

/// The type of the elements of a contiguous range.
template <class R>
using element_of =
    std::remove_cv_t<typename decltype(std::span(std::declval<const R&>()))::element_type>;

/// The number of values of the samples of a range.
template <class R>
inline constexpr std::size_t dimension = length_of_sample<element_of<R>>;

/// A contiguous range of samples: a vector, an array or a span of `std::array<double, D>`.
template <class R>
concept sample_range = dimension<R> > 0;

/// Whether all values are finite, and small enough that no sum of their squares overflows.
template <std::size_t D>
[[nodiscard]] bool is_usable(const std::array<double, D>& x) {
    constexpr double largest = 1e100;  // numerical: against overflow
    for (const double value : x)
        if (!(std::abs(value) <= largest)) return false;
    return true;
}

/// @throws std::invalid_argument  with `message` unless all samples are usable
void require_usable(const auto& samples, const char* message) {
    for (const auto& x : samples) gnomon::detail::require(is_usable(x), message);
}

}  // namespace gnomon::recognition::detail
