// SPDX-License-Identifier: BSL-1.0
/// @file
/// Angles of several directions at once: std::atan2, which has no vectors and cares for the last
/// bit, takes longer than all else that is done with a ray.
#pragma once

#include <cstddef>

#include <gnomon/core/detail/pack.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// atan2(y, x) / (2 pi), from -1/2 to 1/2, to 1e-11; 0 where both are nearer to 0 than 1e-300, and
/// for y = -0 what it is for y = 0. Precondition: both are finite.
template <std::size_t N>
[[nodiscard, gnu::always_inline]] inline pack_of<N> part_of_turn(const pack_of<N>& y,
                                                                 const pack_of<N>& x) {
    const pack_of<N> across = magnitude(x), up = magnitude(y);
    const pack_of<N> more = where_at_least(across, up, across, up);
    const pack_of<N> q = where_at_least(across, up, up, across) /
                         where_at_least(more, 1e-300, more, 1.0);  // within the first octant
    const pack_of<N> q2 = q * q;
    // The polynomial of twelve terms that is closest to atan(q) / (2 pi q) for q in [0, 1], the
    // largest error times q being least; from the exchange algorithm of Remez.
    constexpr double terms[] = {
        -9.353527392242409e-5, 6.8335456820977891e-4,  -0.0023429530453196245,
        0.0051299703433202153, -0.0083579494124714409, 0.011368555134567224,
        -0.014230231439434993, 0.017640210291041877,   -0.022731386513283311,
        0.03183066002475542,   -0.053051637682194315,  0.15915494300121097};
    pack_of<N> part = 0.0;
    for (const double term : terms) part = part * q2 + term;
    part = part * q;
    part = where_at_least(across, up, part, 0.25 - part);
    part = where_at_least(x, 0.0, part, 0.5 - part);
    return where_at_least(y, 0.0, part, -part);
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
