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
        // A stray point a kilometer below or above must neither be the floor nor ask for all
        // memory: the histogram spans all but one in a thousand at either end, and a million bins
        // at most.
        const auto quantile = [&heights](std::size_t rank) {
            const auto nth = heights.begin() + static_cast<std::ptrdiff_t>(rank);
            std::nth_element(heights.begin(), nth, heights.end());
            return *nth;
        };
        const std::size_t cut = heights.size() / 1000;
        lowest_ = quantile(cut);
        const double highest = quantile(heights.size() - 1 - cut);
        constexpr double most_bins = 1 << 20;
        counts_.assign(static_cast<std::size_t>(std::min((highest - lowest_) / bin, most_bins)) + 1,
                       0);
        for (const double h : heights) {
            const double b = std::floor((h - lowest_) / bin);
            if (b >= 0.0 && b < static_cast<double>(counts_.size())) {
                ++counts_[static_cast<std::size_t>(b)];
            }
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
