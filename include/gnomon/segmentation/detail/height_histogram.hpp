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

/// The bins of a histogram of heights.
struct height_histogram {
    struct bin {
        double height;  ///< in its middle [m]
        std::size_t count;
    };
    scratch<bin> bins;       ///< from the lowest up; only those that hold a point
    std::size_t points = 0;  ///< all finite ones, however low

    /// Counts the finite points whose height is at least `from`, in bins of `width` metres, one of
    /// them about the plane itself. An outlier at a distance of kilometers costs no memory.
    /// O(n log n).
    height_histogram(const auto& positions, const plane& ground, double width,
                     double from = -std::numeric_limits<double>::infinity()) {
        scratch<double> numbers;
        numbers.reserve(positions.size());
        for (std::size_t i = 0; i < positions.size(); ++i) {
            if (!is_finite(positions[i])) continue;
            ++points;
            const double height = ground.signed_distance(positions[i]);
            if (height >= from) numbers.push_back(std::round(height / width));
        }
        std::sort(numbers.begin(), numbers.end());
        for (auto first = numbers.begin(); first != numbers.end();) {
            const auto last = std::upper_bound(first, numbers.end(), *first);
            bins.push_back({width * *first, static_cast<std::size_t>(last - first)});
            first = last;
        }
    }
};

/// The lowest bin of those that hold most. Precondition: there are bins. (Not std::ranges, which
/// costs a hundredth of the time to compile all headers.)
[[nodiscard]] const auto& fullest(const auto& histogram) {
    return *std::max_element(histogram.bins.begin(), histogram.bins.end(),
                             [](const auto& a, const auto& b) { return a.count < b.count; });
}

}  // namespace gnomon::detail
