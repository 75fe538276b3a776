// SPDX-License-Identifier: BSL-1.0
/// @file
/// Thirty-two points side by side, and which of them a ball or a box meets, as the bits of a
/// number. Plain loops of fixed length, which compilers turn into vector instructions at -O2
/// already; only the gathering of comparisons into bits is beyond them, and said in instructions
/// where there are some.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

inline constexpr std::size_t lane_count = 32;

/// One number of each of 32 points.
struct alignas(64) lanes {
    float at[lane_count];

    [[nodiscard]] float& operator[](std::size_t l) { return at[l]; }
    [[nodiscard]] const float& operator[](std::size_t l) const { return at[l]; }
};

/// Bit l of the result tells whether a[l] <= limit.
[[nodiscard]] inline std::uint32_t at_most(const lanes& a, float limit) {
#if GNOMON_LANE_BITS == 512
    const __m512 t = _mm512_set1_ps(limit);
    const unsigned low = _mm512_cmp_ps_mask(_mm512_load_ps(a.at), t, _CMP_LE_OQ);
    const unsigned high = _mm512_cmp_ps_mask(_mm512_load_ps(a.at + 16), t, _CMP_LE_OQ);
    return low | high << 16;
#elif GNOMON_LANE_BITS == 256
    const __m256 t = _mm256_set1_ps(limit);
    std::uint32_t bits = 0;
    for (int l = 0; l < 32; l += 8) {
        const __m256 le = _mm256_cmp_ps(_mm256_load_ps(a.at + l), t, _CMP_LE_OQ);
        bits |= static_cast<std::uint32_t>(_mm256_movemask_ps(le)) << l;
    }
    return bits;
#elif GNOMON_LANE_BITS == 128
    const __m128 t = _mm_set1_ps(limit);
    std::uint32_t bits = 0;
#pragma GCC unroll 8
    for (int l = 0; l < 32; l += 4) {
        const __m128 le = _mm_cmple_ps(_mm_load_ps(a.at + l), t);
        bits |= static_cast<std::uint32_t>(_mm_movemask_ps(le)) << l;
    }
    return bits;
#else
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < lane_count; ++l)
        bits |= static_cast<std::uint32_t>(a.at[l] <= limit) << l;
    return bits;
#endif
}

#if GNOMON_LANE_BITS == 256
/// For each set of 8 lanes, the numbers of those in it, first to last.
inline constexpr auto members_table = [] {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (std::size_t set = 0; set < 256; ++set) {
        std::size_t n = 0;
        for (std::uint8_t l = 0; l < 8; ++l)
            if ((set >> l & 1) != 0) table[set][n++] = l;
    }
    return table;
}();
[[nodiscard]] inline __m256i members_of(std::uint32_t set) {
    return _mm256_cvtepu8_epi32(
        _mm_loadl_epi64(reinterpret_cast<const __m128i*>(members_table[set].data())));
}
#endif

/// Writes those of 32 numbers whose bits are set, one after the other. What follows them, up to 32
/// in all, may be overwritten; `out` may be `numbers`, or before.
/// @return the end of what was written
[[gnu::always_inline]] inline std::uint32_t* compress(const std::uint32_t* numbers,
                                                      std::uint32_t bits, std::uint32_t* out) {
#if GNOMON_LANE_BITS == 512
    for (int l = 0; l < 32; l += 16, bits >>= 16) {
        const auto set = static_cast<__mmask16>(bits);
        const __m512i all = _mm512_loadu_si512(numbers + l);
        _mm512_storeu_si512(out, _mm512_maskz_compress_epi32(set, all));
        out += std::popcount(bits & 0xffffu);
    }
#elif GNOMON_LANE_BITS == 256
    for (int l = 0; l < 32; l += 8, bits >>= 8) {
        const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(numbers + l));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out),
                            _mm256_permutevar8x32_epi32(all, members_of(bits & 0xffu)));
        out += std::popcount(bits & 0xffu);
    }
#else
    for (; bits != 0; bits &= bits - 1) *out++ = numbers[std::countr_zero(bits)];
#endif
    return out;
}

/// The same of 32 values and of the numbers first, first + 1, ... beside them.
/// @return how many were written
[[gnu::always_inline]] inline std::size_t compress(const lanes& values, std::uint32_t first,
                                                   std::uint32_t bits, float* out,
                                                   std::uint32_t* out_numbers) {
    const float* const begin = out;
#if GNOMON_LANE_BITS == 512
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
#elif GNOMON_LANE_BITS == 256
    __m256i start = _mm256_set1_epi32(static_cast<int>(first));
    for (int l = 0; l < 32; l += 8, bits >>= 8) {
        const __m256i members = members_of(bits & 0xffu);
        _mm256_storeu_ps(out, _mm256_permutevar8x32_ps(_mm256_load_ps(values.at + l), members));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(out_numbers),
                            _mm256_add_epi32(start, members));
        start = _mm256_add_epi32(start, _mm256_set1_epi32(8));
        const auto n = std::popcount(bits & 0xffu);
        out += n;
        out_numbers += n;
    }
#else
    for (; bits != 0; bits &= bits - 1) {
        const auto l = static_cast<std::uint32_t>(std::countr_zero(bits));
        *out++ = values[l];
        *out_numbers++ = first + l;
    }
#endif
    return static_cast<std::size_t>(out - begin);
}

/// How many of the 32 are at most `limit`.
[[nodiscard]] inline std::size_t count_at_most(const lanes& a, float limit) {
#if defined(__POPCNT__)
    return static_cast<std::size_t>(std::popcount(at_most(a, limit)));
#else
    std::uint32_t n = 0;
    for (std::size_t l = 0; l < lane_count; ++l) n += a.at[l] <= limit ? 1u : 0u;
    return n;
#endif
}

/// The positions of 32 points. Where there are fewer, infinity fills up.
struct lane_points {
    lanes x, y, z;

    void set(std::size_t l, const std::array<float, 3>& p) {
        x[l] = p[0], y[l] = p[1], z[l] = p[2];
    }

    /// The squared distances from (px, py, pz).
    [[nodiscard, gnu::always_inline]] lanes squared_distances(float px, float py, float pz) const {
        lanes d2;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = x.at[l] - px, dy = y.at[l] - py, dz = z.at[l] - pz;
            d2.at[l] = dx * dx + dy * dy + dz * dz;
        }
        return d2;
    }
};

/// Thirty-two boxes, by their middles and half their sides.
struct lane_boxes {
    lanes x, y, z, half_x, half_y, half_z;

    void set(std::size_t l, const std::array<float, 3>& middle, const std::array<float, 3>& half) {
        x[l] = middle[0], y[l] = middle[1], z[l] = middle[2];
        half_x[l] = half[0], half_y[l] = half[1], half_z[l] = half[2];
    }

    /// Four times the squared distances from (px, py, pz); 0 inside.
    [[nodiscard, gnu::always_inline]] lanes squared_distances_times_4(float px, float py,
                                                                      float pz) const {
        lanes d2;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = std::abs(x.at[l] - px) - half_x.at[l];
            const float dy = std::abs(y.at[l] - py) - half_y.at[l];
            const float dz = std::abs(z.at[l] - pz) - half_z.at[l];
            // d + |d| is twice the larger of d and 0, which compilers would not vectorise.
            const float gx = dx + std::abs(dx), gy = dy + std::abs(dy), gz = dz + std::abs(dz);
            d2.at[l] = gx * gx + gy * gy + gz * gz;
        }
        return d2;
    }
};

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
