// SPDX-License-Identifier: BSL-1.0
/// @file
/// Pairs of regions: those next to each other, or those to compare.
#pragma once

#include <algorithm>
#include <utility>

#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// Two regions, the smaller number first.
using region_pair = std::pair<point_index, point_index>;

/// Adds a pair to others, unless it is there; the latest ones are compared first.
void add_once(const auto& pair, auto& others) {
    if (std::find(others.rbegin(), others.rend(), pair) == others.rend()) others.push_back(pair);
}

/// Sorts pairs, and leaves each once.
void make_unique(auto& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

}  // namespace gnomon::detail
