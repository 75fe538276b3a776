// SPDX-License-Identifier: BSL-1.0
/// @file
/// atan2 of several directions at once, in vector instructions. std::atan2 is scalar and correct to
/// the last bit; its time would exceed that of all other steps of projecting a point to a range
/// image.
#pragma once

#include <cstddef>

#include <gnomon/core/detail/pack.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// atan2(y, x) / pi in [-1, 1], the atan2pi of C23, with an absolute error of at most 2e-11. The
/// sign of zero is ignored, atan2pi(0, 0) is 0, and the result is inaccurate if |x| and |y| are
/// both below 1e-300. Precondition: x and y are finite.
template <std::size_t N>
[[nodiscard, GNOMON_ALWAYS_INLINE]] inline pack_of<N> atan2pi(const pack_of<N>& y,
                                                              const pack_of<N>& x) {
    const pack_of<N> across = magnitude(x), up = magnitude(y);
    const pack_of<N> more = where_at_least(across, up, across, up);
    const pack_of<N> q = where_at_least(across, up, up, across) /
                         where_at_least(more, 1e-300, more, 1.0);  // within the first octant
    const pack_of<N> q2 = q * q;
    // Coefficients of the polynomial in q^2, of twelve terms, that minimizes the largest error of
    // atan(q) / pi over q in [0, 1]; computed by the Remez exchange algorithm.
    constexpr double terms[] = {
        -1.8707054784484818e-4, 1.36670913641955782e-3, -0.004685906090639249,
        0.0102599406866404428,  -0.0167158988249428818, 0.022737110269134448,
        -0.028460462878869986,  0.035280420582082254,   -0.045462773026566622,
        0.06366132004951084,    -0.10610327536438863,   0.31830988600242194};
    pack_of<N> angle = 0.0;
    for (const double term : terms) angle = angle * q2 + term;
    angle = angle * q;
    angle = where_at_least(across, up, angle, 0.5 - angle);
    angle = where_at_least(x, 0.0, angle, 1.0 - angle);
    return where_at_least(y, 0.0, angle, -angle);
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
