// SPDX-License-Identifier: BSL-1.0
/// @file
/// How many points lie at which height above a plane.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// Counts the finite points whose height is at least `from`, in bins of `bin` metres.
class height_histogram {
  public:
    template <class Points>
    height_histogram(const Points& points, const plane& ground, double bin,
                     double from = -std::numeric_limits<double>::infinity())
        : bin_(bin) {
        std::vector<double> heights;
        heights.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_finite(points[i])) continue;
            ++points_;
            const double h = ground.signed_distance(points[i]);
            if (h >= from) heights.push_back(h);
        }
        if (heights.empty()) return;
        const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
        lowest_ = *low;
        // A stray point at 1e9 m must not ask for 1e11 bins: what is too high goes to the last one.
        constexpr double most_bins = 1 << 20;
        const double bins = std::min(std::floor((*high - *low) / bin) + 1.0, most_bins);
        counts_.assign(static_cast<std::size_t>(bins), 0);
        for (const double h : heights) {
            ++counts_[static_cast<std::size_t>(std::min((h - lowest_) / bin, bins - 1.0))];
        }
    }

    /// From the lowest bin up; empty if no point is high enough.
    [[nodiscard]] const std::vector<std::size_t>& counts() const { return counts_; }
    /// The height in the middle of bin b [m].
    [[nodiscard]] double center(std::size_t b) const {
        return lowest_ + (static_cast<double>(b) + 0.5) * bin_;
    }
    /// All finite points, however low.
    [[nodiscard]] std::size_t points() const { return points_; }

  private:
    double bin_;
    double lowest_ = 0.0;
    std::size_t points_ = 0;
    std::vector<std::size_t> counts_;
};

}  // namespace gnomon::detail
