// SPDX-License-Identifier: BSL-1.0
/// @file
/// The implementation of `tie_rule::all` that all searches share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// The number of neighbors that `tie_rule::all` keeps of a list in canonical order: the k nearest
/// and those at the distance of the k-th, but at most `most`.
template <class Sorted, class Proj = std::identity>
[[nodiscard]] std::size_t size_with_ties(const Sorted& found, std::size_t k, std::size_t most,
                                         Proj neighbor_of = {}) {
    if (k == 0 || found.size() <= k) return k;
    const double limit = neighbor_of(found[k - 1]).squared_distance * (1.0 + 1e-9);
    std::size_t kept = k;
    while (kept < std::min(found.size(), most) &&
           neighbor_of(found[kept]).squared_distance <= limit) {
        ++kept;
    }
    return kept;
}

}  // namespace gnomon::detail
