// SPDX-License-Identifier: BSL-1.0
/// @file
/// How many points lie at which height above a plane.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// Counts the finite points whose height is at least `from`, in bins of `bin` metres, one of them
/// about the plane itself. Keeps only bins that hold a point: an outlier at a distance of
/// kilometers costs no memory. O(n log n).
class height_histogram {
  public:
    struct bin {
        double height;  ///< in its middle [m]
        std::size_t count;
    };

    template <class Points>
    height_histogram(const Points& points, const plane& ground, double width,
                     double from = -std::numeric_limits<double>::infinity()) {
        scratch<double> numbers;
        numbers.reserve(points.size());
        for (std::size_t i = 0; i < points.size(); ++i) {
            if (!is_finite(points[i])) continue;
            ++points_;
            const double height = ground.signed_distance(points[i]);
            if (height >= from) numbers.push_back(std::round(height / width));
        }
        std::sort(numbers.begin(), numbers.end());
        for (auto first = numbers.begin(); first != numbers.end();) {
            const auto last = std::upper_bound(first, numbers.end(), *first);
            bins_.push_back({width * *first, static_cast<std::size_t>(last - first)});
            first = last;
        }
    }

    /// From the lowest up; empty if no point is high enough.
    [[nodiscard]] const scratch<bin>& bins() const { return bins_; }
    /// All finite points, however low.
    [[nodiscard]] std::size_t points() const { return points_; }

  private:
    std::size_t points_ = 0;
    scratch<bin> bins_;
};

/// The lowest bin of those that hold most. Precondition: there are bins.
[[nodiscard]] const height_histogram::bin& fullest(const auto& histogram) {
    return *std::max_element(histogram.bins().begin(), histogram.bins().end(),
                             [](const auto& a, const auto& b) { return a.count < b.count; });
}

}  // namespace gnomon::detail
