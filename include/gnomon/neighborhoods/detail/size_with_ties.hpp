// SPDX-License-Identifier: BSL-1.0
/// @file
/// `tie_rule::all`, said once for all searches.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>

#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

/// How many of a list in canonical order are kept by `tie_rule::all`: the k nearest, and those that
/// are as far, as long as they are `most` together at most.
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
