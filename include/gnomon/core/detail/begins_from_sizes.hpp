// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where each group of an array begins that holds groups one after the other.
#pragma once

#include <cstddef>

namespace gnomon::detail {

/// Replaces sizes by begins: begin[g + 1] is the size of group g before and where group g + 1
/// begins afterwards. Precondition: begin[0] is 0. (std::partial_sum would do, but costs every user
/// of a graph the time to compile <numeric>.)
void begins_from_sizes(auto& begin) {
    for (std::size_t g = 1; g < begin.size(); ++g) begin[g] += begin[g - 1];
}

}  // namespace gnomon::detail
