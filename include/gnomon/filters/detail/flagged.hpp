// SPDX-License-Identifier: BSL-1.0
/// @file
/// From flags of points to their indices.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// The indices of the flags that are not 0, ascending. Flags are bytes: threads set them side by
/// side.
[[nodiscard]] inline std::vector<point_index> flagged(std::span<const std::uint8_t> flags) {
    std::size_t count = 0;
    for (const std::uint8_t flag : flags) count += flag != 0 ? 1 : 0;
    std::vector<point_index> indices;
    indices.reserve(count);
    for (std::size_t i = 0; i < flags.size(); ++i)
        if (flags[i] != 0) indices.push_back(static_cast<point_index>(i));
    return indices;
}

}  // namespace gnomon::detail
