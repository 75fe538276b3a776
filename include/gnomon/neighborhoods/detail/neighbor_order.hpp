// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sorts few neighbors into canonical order. The key of a neighbor is a 32-bit integer: the leading
/// bits of its squared distance as a float, then its number in the list. Rounding to a float does
/// not change the order of two distances, unless it makes them equal. So a sorting network of the
/// keys gives the canonical order up to neighbors with equal leading bits; these are compared by
/// their distances in double and by their indices.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/sorting_network.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// The canonical order of at most `Most` neighbors, which have the numbers 0 to n - 1. (A template,
/// so that only users of a search compile it.)
template <std::size_t Most = 128>
class neighbor_order {
  public:
    static constexpr std::size_t most = Most;

    /// Sorts n neighbors: number j has the squared distance squared[j] [m^2], finite and not
    /// negative, and the index index_of(j). O(n log^2 n).
    neighbor_order(std::span<const double> squared, auto&& index_of) {
        constexpr double largest = std::numeric_limits<float>::max();
        for (std::size_t j = 0; j < squared.size(); ++j) {
            const auto rounded = static_cast<float>(std::min(squared[j], largest));
            keys_[j] = (std::bit_cast<std::int32_t>(rounded) & ~number_bits) |
                       static_cast<std::int32_t>(j);
        }
        if (!sort_keys(squared.size())) return;
        sort_equal_keys(squared.size(), [&](std::size_t j) {
            return neighbor{squared[j], index_of(j)};
        });
    }

    /// The number of the neighbor of a rank; the nearest neighbor has the rank 0.
    [[nodiscard]] std::size_t operator[](std::size_t rank) const { return number_of(keys_[rank]); }

  private:
    static constexpr std::int32_t number_bits = Most - 1;
    static_assert(std::has_single_bit(Most));

    [[nodiscard]] static std::size_t number_of(std::int32_t key) {
        return static_cast<std::size_t>(key & number_bits);
    }

    /// Sorts the n keys.
    /// @return whether two of them have equal leading bits
    bool sort_keys(std::size_t n) {
        return with_widest([&](auto instructions) {
            using network = sorting_network<decltype(instructions)>;
            const std::size_t length = network::length_for(n);
            // The keys that fill the list up are greater than the others and differ in their
            // leading bits.
            for (std::size_t j = n; j <= length; ++j)
                keys_[j] =
                    std::numeric_limits<std::int32_t>::max() - static_cast<std::int32_t>(Most * j);
            network::sort(keys_.data(), length);
            return network::has_equal_successors(keys_.data(), length, number_bits);
        });
    }

    /// Sorts the keys with equal leading bits by neighbor_of(number).
    void sort_equal_keys(std::size_t n, auto&& neighbor_of) {
        const auto end = keys_.begin() + static_cast<std::ptrdiff_t>(n);
        for (auto first = keys_.begin(); first != end;) {
            const auto last = std::find_if(first + 1, end, [&](std::int32_t key) {
                return (key | number_bits) != (*first | number_bits);
            });
            std::sort(first, last, [&](std::int32_t a, std::int32_t b) {
                return neighbor_of(number_of(a)) < neighbor_of(number_of(b));
            });
            first = last;
        }
    }

    alignas(32) std::array<std::int32_t, Most + 1> keys_;  // in ascending order
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
