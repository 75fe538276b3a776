// SPDX-License-Identifier: BSL-1.0
/// @file
/// A hash of whole numbers, for tables of cells.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace gnomon::detail {

/// Fibonacci hashing (Knuth), one number after the other: the multiplier is 2^64 over the golden
/// ratio.
template <std::size_t N>
[[nodiscard]] constexpr std::uint64_t hash_of(const std::array<std::int64_t, N>& numbers) {
    std::uint64_t hash = 0;
    for (const std::int64_t number : numbers) {
        hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x9e3779b97f4a7c15u;
        hash ^= hash >> 32;
    }
    return hash;
}

}  // namespace gnomon::detail
