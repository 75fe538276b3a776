// SPDX-License-Identifier: BSL-1.0
/// @file
/// The boxes of a kd-tree, and how far they are from each other and from a point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace gnomon::detail {

/// An axis-aligned box.
struct leaf_box {
    std::array<double, 3> low, high;

    void add(const std::array<double, 3>& p) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], p[a]);
            high[a] = std::max(high[a], p[a]);
        }
    }
    /// From the nearest point of one box to the nearest of the other [m^2]; 0 if they overlap.
    [[nodiscard]] double squared_distance_to(const leaf_box& other) const {
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) {
            const double gap = std::max({other.low[a] - high[a], low[a] - other.high[a], 0.0});
            sum += gap * gap;
        }
        return sum;
    }
    /// Whether all points in it are at one position.
    [[nodiscard]] bool is_point() const { return low == high; }
    [[nodiscard]] double squared_diagonal() const {
        double sum = 0.0;
        for (std::size_t a = 0; a < 3; ++a) sum += (high[a] - low[a]) * (high[a] - low[a]);
        return sum;
    }
};

}  // namespace gnomon::detail
