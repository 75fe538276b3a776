// SPDX-License-Identifier: BSL-1.0
/// @file
/// Comparison of 32 numbers with a limit, with a bit mask as the result, and compression of the
/// numbers in a mask: compilers do not generate the instructions for these by themselves. Each
/// instruction set has a class, and with_widest() runs a loop with the widest set available: that
/// of the compiler's flags, and on x86-64 AVX2 as well if the processor has it, whatever the flags.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/neighborhoods/detail/lanes.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Plain loops.
struct plain_instructions {
#if defined(GNOMON_SCALAR_LANES)
    using integers = int;
#else
    using integers [[gnu::vector_size(16), gnu::may_alias]] = int;
#endif

    /// Bit l of the result is set if a[l] <= limit.
    [[nodiscard]] static std::uint32_t at_most(const lanes& a, float limit) {
        std::uint32_t bits = 0;
        for (std::size_t l = 0; l < lane_count; ++l)
            bits |= static_cast<std::uint32_t>(a[l] <= limit) << l;
        return bits;
    }

    /// How many of the 32 are at most `limit`.
    [[nodiscard]] static std::size_t count_at_most(const lanes& a, float limit) {
        std::uint32_t n = 0;
        for (std::size_t l = 0; l < lane_count; ++l) n += a[l] <= limit ? 1u : 0u;
        return n;
    }

    /// Writes the numbers whose bits are set, one after the other, out of 32 numbers of 32 bits
    /// each. Memory after them, up to 32 numbers in total, may be overwritten; `out` may be
    /// `numbers` or lie before it.
    /// @return the end of the numbers written
    template <class T>
        requires(sizeof(T) == 4)
    static T* compress(const T* numbers, std::uint32_t bits, T* out) {
        for (; bits != 0; bits &= bits - 1) *out++ = numbers[std::countr_zero(bits)];
        return out;
    }

    /// The same for 32 values and for the numbers first, first + 1, ... that belong to them.
    /// @return how many were written
    static std::size_t compress(const lanes& values, std::uint32_t first, std::uint32_t bits,
                                float* out, std::uint32_t* out_numbers) {
        const float* const begin = out;
        for (; bits != 0; bits &= bits - 1) {
            const auto l = static_cast<std::uint32_t>(std::countr_zero(bits));
            *out++ = values[l];
            *out_numbers++ = first + l;
        }
        return static_cast<std::size_t>(out - begin);
    }
};

#if GNOMON_LANE_BITS == 128
struct sse2_instructions : plain_instructions {
    [[nodiscard]] static std::uint32_t at_most(const lanes& a, float limit) {
        const __m128 t = _mm_set1_ps(limit);
        std::uint32_t bits = 0;
        GNOMON_UNROLL(8)
        for (int l = 0; l < 32; l += 4) {
            const __m128 le = _mm_cmple_ps(_mm_load_ps(a.at + l), t);
            bits |= static_cast<std::uint32_t>(_mm_movemask_ps(le)) << l;
        }
        return bits;
    }
};
#endif

#if GNOMON_LANE_BITS == 256 || defined(GNOMON_LANES_UP_TO_AVX2)
/// By the compilers' built-in vectors and functions: the header of these instructions takes long to
/// compile.
class avx2_instructions {
  public:
    using integers [[gnu::vector_size(32), gnu::may_alias]] = int;

    [[nodiscard, GNOMON_WITH_AVX2]] static std::uint32_t at_most(const lanes& a, float limit) {
        const floats t = limit - floats{};
        std::uint32_t bits = 0;
        GNOMON_UNROLL(4)
        for (int l = 0; l < 32; l += 8)
            bits |= bits_of(reinterpret_cast<const floats&>(a.at[l]) <= t) << l;
        return bits;
    }

    [[nodiscard, GNOMON_WITH_AVX2]] static std::size_t count_at_most(const lanes& a, float limit) {
        // Bytes of a packed mask are in another order, which does not matter for their number.
        const floats t = limit - floats{};
        const auto* const all = reinterpret_cast<const floats*>(a.at);
        const auto first = __builtin_ia32_packssdw256(all[0] <= t, all[1] <= t);
        const auto second = __builtin_ia32_packssdw256(all[2] <= t, all[3] <= t);
        const auto mask = __builtin_ia32_packsswb256(first, second);
        return static_cast<std::size_t>(
            std::popcount(static_cast<std::uint32_t>(__builtin_ia32_pmovmskb256(mask))));
    }

    template <class T>
        requires(sizeof(T) == 4)
    [[GNOMON_WITH_AVX2]] static T* compress(const T* numbers, std::uint32_t bits, T* out) {
        for (int l = 0; l < 32; l += 8, bits >>= 8) {
            integers kept;
            std::memcpy(&kept, numbers + l, sizeof kept);
            kept = __builtin_ia32_permvarsi256(kept, members_of(bits & 0xffu));
            std::memcpy(out, &kept, sizeof kept);
            out += std::popcount(bits & 0xffu);
        }
        return out;
    }

    [[GNOMON_WITH_AVX2]] static std::size_t compress(const lanes& values, std::uint32_t first,
                                                     std::uint32_t bits, float* out,
                                                     std::uint32_t* out_numbers) {
        const float* const begin = out;
        for (int l = 0; l < 32; l += 8, bits >>= 8) {
            const integers members = members_of(bits & 0xffu);
            const floats kept =
                __builtin_ia32_permvarsf256(reinterpret_cast<const floats&>(values.at[l]), members);
            const integers numbers = members + (static_cast<int>(first) + l);
            std::memcpy(out, &kept, sizeof kept);
            std::memcpy(out_numbers, &numbers, sizeof numbers);
            const auto n = std::popcount(bits & 0xffu);
            out += n;
            out_numbers += n;
        }
        return static_cast<std::size_t>(out - begin);
    }

  private:
    using floats [[gnu::vector_size(32), gnu::may_alias]] = float;

    [[GNOMON_WITH_AVX2]] static std::uint32_t bits_of(const integers& all_or_none) {
        return static_cast<std::uint32_t>(
            __builtin_ia32_movmskps256(reinterpret_cast<const floats&>(all_or_none)));
    }

    /// Those of 8 lanes that are in a set, first to last.
    [[GNOMON_WITH_AVX2]] static integers members_of(std::uint32_t set) {
        return (static_cast<int>(table[set]) - integers{}) >>
                   integers{0, 4, 8, 12, 16, 20, 24, 28} &
               7;
    }

    /// For each set, its members from the lowest four bits on.
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> members{};
        for (std::uint32_t set = 0; set < 256; ++set) {
            int n = 0;
            for (std::uint32_t l = 0; l < 8; ++l)
                if ((set >> l & 1) != 0) members[set] |= l << 4 * n++;
        }
        return members;
    }();
};
#endif

#if GNOMON_LANE_BITS == 512
struct avx512_instructions {
    using integers [[gnu::vector_size(32), gnu::may_alias]] = int;  // of which few fill one

    [[nodiscard]] static std::uint32_t at_most(const lanes& a, float limit) {
        const __m512 t = _mm512_set1_ps(limit);
        const unsigned low = _mm512_cmp_ps_mask(_mm512_load_ps(a.at), t, _CMP_LE_OQ);
        const unsigned high = _mm512_cmp_ps_mask(_mm512_load_ps(a.at + 16), t, _CMP_LE_OQ);
        return low | high << 16;
    }

    [[nodiscard]] static std::size_t count_at_most(const lanes& a, float limit) {
        return static_cast<std::size_t>(std::popcount(at_most(a, limit)));
    }

    template <class T>
        requires(sizeof(T) == 4)
    static T* compress(const T* numbers, std::uint32_t bits, T* out) {
        for (int l = 0; l < 32; l += 16, bits >>= 16) {
            const auto set = static_cast<__mmask16>(bits);
            const __m512i all = _mm512_loadu_si512(numbers + l);
            _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(set, all));
            out += std::popcount(bits & 0xffffu);
        }
        return out;
    }

    static std::size_t compress(const lanes& values, std::uint32_t first, std::uint32_t bits,
                                float* out, std::uint32_t* out_numbers) {
        const float* const begin = out;
        __m512i numbers = _mm512_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
        numbers = _mm512_add_epi32(numbers, _mm512_set1_epi32(static_cast<int>(first)));
        for (int l = 0; l < 32; l += 16, bits >>= 16) {
            const auto set = static_cast<__mmask16>(bits);
            _mm512_storeu_ps(out, _mm512_maskz_compress_ps(set, _mm512_load_ps(values.at + l)));
            _mm512_storeu_si512(out_numbers, _mm512_maskz_compress_epi32(set, numbers));
            numbers = _mm512_add_epi32(numbers, _mm512_set1_epi32(16));
            const auto n = std::popcount(bits & 0xffffu);
            out += n;
            out_numbers += n;
        }
        return static_cast<std::size_t>(out - begin);
    }
};
#endif

/// The instruction set of the compiler's flags.
#if GNOMON_LANE_BITS == 512
using compiled_instructions = avx512_instructions;
#elif GNOMON_LANE_BITS == 256
using compiled_instructions = avx2_instructions;
#elif GNOMON_LANE_BITS == 128
using compiled_instructions = sse2_instructions;
#else
using compiled_instructions = plain_instructions;
#endif

#if defined(GNOMON_LANES_UP_TO_AVX2)
[[nodiscard]] inline bool has_avx2() {
    return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
           __builtin_cpu_supports("bmi") && __builtin_cpu_supports("popcnt");
}

/// Flattened: all that the loop calls becomes part of this function, and so gets its instructions.
template <class Loop>
[[GNOMON_WITH_AVX2, gnu::flatten]] auto with_avx2(const Loop& loop) {
    return loop(avx2_instructions{});
}
#endif

/// The result of loop(instructions).
template <class Loop>
[[GNOMON_ALWAYS_INLINE]] inline auto with_widest(const Loop& loop) {
#if defined(GNOMON_LANES_UP_TO_AVX2)
    if (has_avx2()) return with_avx2(loop);
#endif
    return loop(compiled_instructions{});
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
