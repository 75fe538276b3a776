// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sorts short lists of integers without branches: Batcher's bitonic sorting network (Batcher 1968,
/// "Sorting networks and their applications"), on vectors of integers.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <gnomon/core/detail/instruction_set.hpp>

/// Vectors of lanes of two others, of which the second continues the numbers of the first.
#if defined(__clang__) || (defined(__GNUC__) && __GNUC__ >= 12)
#define GNOMON_SHUFFLED(a, b, lane) __builtin_shufflevector(a, b, (lane)...)
#else
#define GNOMON_SHUFFLED(a, b, lane) __builtin_shuffle(a, b, vector{static_cast<int>(lane)...})
#endif

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// A network on the vectors of integers of an instruction set. Vectors are passed by reference: by
/// value, they would change the calling convention where the compiler's flags do not include the
/// instruction set.
template <class Instructions>
class sorting_network {
    using vector = typename Instructions::integers;
    static constexpr std::size_t width = sizeof(vector) / sizeof(int);

  public:
    /// The least length that can be sorted and holds n integers.
    [[nodiscard]] static constexpr std::size_t length_for(std::size_t n) {
        return width * std::bit_ceil((n + width - 1) / width);
    }

    /// Sorts `list` in ascending order. O(n log^2 n).
    /// Precondition: n = length_for(n), and `list` is aligned for a vector.
    [[GNOMON_ALWAYS_INLINE]] static void sort(std::int32_t* list, std::size_t n) {
        auto* const all = reinterpret_cast<vector*>(list);
        const std::size_t vectors = n / width;
        for (std::size_t v = 0; v < vectors; ++v) sort_lanes<2>(all[v]);
        for (std::size_t sorted = 1; sorted < vectors; sorted *= 2)
            for (std::size_t v = 0; v < vectors; v += 2 * sorted) merge(all + v, sorted);
    }

    /// Whether two successive integers of `list` are equal apart from their lowest bits, the bits
    /// of `ignored`. The integer after the list is the successor of the last one.
    ///
    /// Precondition: n = length_for(n), and no integer is negative.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] static bool has_equal_successors(const std::int32_t* list,
                                                                         std::size_t n,
                                                                         std::int32_t ignored) {
        vector equal = {};  // lanes are not 0 if so
        for (std::size_t i = 0; i < n; i += width) {
            vector these, next;
            std::memcpy(&these, list + i, sizeof these);
            std::memcpy(&next, list + i + 1, sizeof next);
            equal |= (these ^ next) <= ignored;
        }
#if defined(GNOMON_SCALAR_LANES)
        return equal != 0;
#else
        std::int32_t any = 0;
        for (std::size_t l = 0; l < width; ++l) any |= equal[l];
        return any != 0;
#endif
    }

  private:
    /// Merges two sorted lists of `vectors` vectors each, one after the other.
    [[GNOMON_ALWAYS_INLINE]] static void merge(vector* list, std::size_t vectors) {
        // The second list backwards makes both one bitonic list.
        for (std::size_t v = 0; v < vectors; ++v) {
            vector& second = list[2 * vectors - 1 - v];
            reverse(second, lanes_of_vector{});
            exchange(list[v], second);
        }
        for (std::size_t apart = vectors / 2; apart > 0; apart /= 2)
            for (std::size_t first = 0; first < 2 * vectors; first += 2 * apart)
                for (std::size_t v = first; v < first + apart; ++v)
                    exchange(list[v], list[v + apart]);
        for (std::size_t v = 0; v < 2 * vectors; ++v) merge_lanes<width / 2>(list[v]);
    }

    /// Sorts the lanes of a vector, of which `Length` / 2 successive ones are sorted already.
    template <std::size_t Length>
    [[GNOMON_ALWAYS_INLINE]] static void sort_lanes(vector& v) {
        if constexpr (Length <= width) {
            exchange_lanes<Length - 1, Length / 2>(v, lanes_of_vector{});
            merge_lanes<Length / 4>(v);
            sort_lanes<2 * Length>(v);
        }
    }

    /// Sorts each 2 `Apart` successive lanes, which are a bitonic list.
    template <std::size_t Apart>
    [[GNOMON_ALWAYS_INLINE]] static void merge_lanes(vector& v) {
        if constexpr (Apart > 0) {
            exchange_lanes<Apart, Apart>(v, lanes_of_vector{});
            merge_lanes<Apart / 2>(v);
        }
    }

    using lanes_of_vector = std::make_index_sequence<width>;

#if defined(GNOMON_SCALAR_LANES)
    static void reverse(vector&, lanes_of_vector) {}
#else
    /// Sorts lanes l and l ^ `Partner`; the one without the bit `Upper` gets the lesser.
    template <std::size_t Partner, std::size_t Upper, std::size_t... L>
    [[GNOMON_ALWAYS_INLINE]] static void exchange_lanes(vector& v, std::index_sequence<L...>) {
        vector other = GNOMON_SHUFFLED(v, v, (L ^ Partner));
        exchange(v, other);
        v = GNOMON_SHUFFLED(v, other, ((L & Upper) != 0 ? L + width : L));
    }

    template <std::size_t... L>
    [[GNOMON_ALWAYS_INLINE]] static void reverse(vector& v, std::index_sequence<L...>) {
        v = GNOMON_SHUFFLED(v, v, (width - 1 - L));
    }
#endif

    /// Leaves in each lane of a the lesser integer, and in b the greater.
    [[GNOMON_ALWAYS_INLINE]] static void exchange(vector& a, vector& b) {
        const vector lesser = a < b ? a : b;
        b = a < b ? b : a;
        a = lesser;
    }
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail

#undef GNOMON_SHUFFLED
