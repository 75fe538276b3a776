// SPDX-License-Identifier: BSL-1.0
/// @file
/// Arithmetic on several numbers at once, in the built-in vectors of g++ and clang: these become
/// vector instructions without an optimiser, and compile faster than expression templates. Where
/// there are none, a vector is a single double.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/instruction_set.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// The size of a vector of the instruction set [bytes].
inline constexpr std::size_t vector_bytes = GNOMON_LANE_BITS == 0 ? 16 : GNOMON_LANE_BITS / 8;

/// N numbers, a multiple of the numbers in a vector.
template <std::size_t N>
class pack_of {
  public:
    static constexpr std::size_t size = N;

    pack_of() = default;
    [[GNOMON_ALWAYS_INLINE]] explicit(false) pack_of(double x) {
        for (vector& v : at_) v = x - vector{};
    }
    /// Those from `first` on.
    [[GNOMON_ALWAYS_INLINE]] explicit pack_of(const double* first) {
        std::memcpy(at_, first, sizeof at_);
    }

    /// Those at some places.
    [[GNOMON_ALWAYS_INLINE]] pack_of(const double* first, const std::uint32_t* places) {
        for (std::size_t v = 0; v < size / width; ++v)
            at_[v] = gather(first, places + v * width, std::make_index_sequence<width>{});
    }

    [[nodiscard]] double operator[](std::size_t l) const {
#if defined(GNOMON_SCALAR_LANES)
        return at_[l];
#else
        return at_[l / width][l % width];
#endif
    }

    [[nodiscard]] double sum() const {
        double all = 0.0;
        for (std::size_t l = 0; l < size; ++l) all += (*this)[l];
        return all;
    }

    [[GNOMON_ALWAYS_INLINE]] friend pack_of operator+(const pack_of& a, const pack_of& b) {
        return of([&](std::size_t v) { return a.at_[v] + b.at_[v]; });
    }
    [[GNOMON_ALWAYS_INLINE]] friend pack_of operator-(const pack_of& a, const pack_of& b) {
        return of([&](std::size_t v) { return a.at_[v] - b.at_[v]; });
    }
    [[GNOMON_ALWAYS_INLINE]] friend pack_of operator*(const pack_of& a, const pack_of& b) {
        return of([&](std::size_t v) { return a.at_[v] * b.at_[v]; });
    }
    [[GNOMON_ALWAYS_INLINE]] friend pack_of operator/(const pack_of& a, const pack_of& b) {
        return of([&](std::size_t v) { return a.at_[v] / b.at_[v]; });
    }
    [[GNOMON_ALWAYS_INLINE]] friend pack_of operator-(const pack_of& a) {
        return of([&](std::size_t v) { return -a.at_[v]; });
    }
    [[GNOMON_ALWAYS_INLINE]] pack_of& operator+=(const pack_of& b) { return *this = *this + b; }

    [[GNOMON_ALWAYS_INLINE]] friend pack_of magnitude(const pack_of& a) {
        return of([&](std::size_t v) { return a.at_[v] < 0.0 ? -a.at_[v] : a.at_[v]; });
    }
    /// a where x >= y, and b elsewhere.
    [[GNOMON_ALWAYS_INLINE]] friend pack_of where_at_least(const pack_of& x, const pack_of& y,
                                                           const pack_of& a, const pack_of& b) {
        return of([&](std::size_t v) { return x.at_[v] >= y.at_[v] ? a.at_[v] : b.at_[v]; });
    }
    /// The nearest from low to high. Precondition: low <= high.
    [[GNOMON_ALWAYS_INLINE]] friend pack_of clamp(const pack_of& a, const pack_of& low,
                                                  const pack_of& high) {
        return of([&](std::size_t v) {
            const vector x = a.at_[v] < low.at_[v] ? low.at_[v] : a.at_[v];
            return high.at_[v] < x ? high.at_[v] : x;
        });
    }
    /// Bit l of the result is set if a[l] <= limit.
    [[nodiscard, GNOMON_ALWAYS_INLINE]] friend std::uint32_t at_most(const pack_of& a,
                                                                     double limit) {
        std::uint32_t bits = 0;
        GNOMON_UNROLL(4)
        for (std::size_t v = 0; v < size / width; ++v)
            bits |= at_most(a.at_[v], limit) << v * width;
        return bits;
    }
    /// The square roots. (std::sqrt, which may have to set errno, would be called one by one.)
    [[GNOMON_ALWAYS_INLINE]] friend pack_of root(const pack_of& a) {
        return of([&](std::size_t v) {
#if GNOMON_LANE_BITS == 512
            return static_cast<vector>(_mm512_maskz_sqrt_pd(0xff, static_cast<__m512d>(a.at_[v])));
#elif GNOMON_LANE_BITS == 256
            return static_cast<vector>(_mm256_sqrt_pd(static_cast<__m256d>(a.at_[v])));
#elif GNOMON_LANE_BITS == 128
            return static_cast<vector>(_mm_sqrt_pd(static_cast<__m128d>(a.at_[v])));
#elif defined(GNOMON_SCALAR_LANES)
            return std::sqrt(a.at_[v]);
#else
            vector r = a.at_[v];
            for (std::size_t l = 0; l < width; ++l) r[l] = std::sqrt(r[l]);
            return r;
#endif
        });
    }

  private:
#if defined(GNOMON_SCALAR_LANES)
    using vector = double;
#else
    using vector [[gnu::vector_size(vector_bytes)]] = double;
#endif
    static constexpr std::size_t width = sizeof(vector) / sizeof(double);
    static_assert(N > 0 && N % width == 0 && N <= 32);

    template <std::size_t... L>
    [[GNOMON_ALWAYS_INLINE]] static vector gather(const double* first, const std::uint32_t* places,
                                                  std::index_sequence<L...>) {
        return vector{first[places[L]]...};
    }

    [[GNOMON_ALWAYS_INLINE]] static pack_of of(auto&& each) {
        pack_of p;
        GNOMON_UNROLL(4)
        for (std::size_t v = 0; v < size / width; ++v) p.at_[v] = each(v);
        return p;
    }

    [[GNOMON_ALWAYS_INLINE]] static std::uint32_t at_most(const vector& a, double limit) {
#if GNOMON_LANE_BITS == 512
        return _mm512_cmp_pd_mask(static_cast<__m512d>(a), _mm512_set1_pd(limit), _CMP_LE_OQ);
#elif GNOMON_LANE_BITS == 256
        const __m256d le =
            _mm256_cmp_pd(static_cast<__m256d>(a), _mm256_set1_pd(limit), _CMP_LE_OQ);
        return static_cast<std::uint32_t>(_mm256_movemask_pd(le));
#elif GNOMON_LANE_BITS == 128
        return static_cast<std::uint32_t>(
            _mm_movemask_pd(_mm_cmple_pd(static_cast<__m128d>(a), _mm_set1_pd(limit))));
#elif defined(GNOMON_SCALAR_LANES)
        return a <= limit ? 1u : 0u;
#else
        std::uint32_t bits = 0;
        for (std::size_t l = 0; l < width; ++l) bits |= (a[l] <= limit ? 1u : 0u) << l;
        return bits;
#endif
    }

    vector at_[size / width];
};

/// The numbers of two vectors, at most 8: enough for divisions and roots to overlap. More would not
/// fit into the 16 registers of SSE2 and would take longer to compile.
using pack = pack_of<(vector_bytes > 32 ? 8 : 2 * vector_bytes / sizeof(double))>;
/// The numbers of one vector: for more sums than would fit into the registers otherwise.
using slim_pack = pack_of<vector_bytes / sizeof(double)>;

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
