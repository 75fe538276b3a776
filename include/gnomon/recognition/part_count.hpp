// SPDX-License-Identifier: BSL-1.0
/// @file
/// The number of detected parts as evidence for a class. Klasing 2010, Eq. (5.17).
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <span>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::recognition {

/// A normal distribution of a number, rounded to integers and cut at zero.
struct part_count {
    double mean = 0.0, deviation = 0.5;  ///< of the number of parts of a view

    /// The distribution of these numbers. The deviation is at least 0.5, so that a number that was
    /// always the same does not exclude its neighbors.
    [[nodiscard]] static part_count of(std::span<const double> numbers) {
        constexpr double least = 0.5;  // chosen; see docs/thesis-notes.md, A29
        const auto n = static_cast<double>(numbers.size());
        double sum = 0.0, squares = 0.0;
        for (const double x : numbers) sum += x;
        const double mean = n > 0.0 ? sum / n : 0.0;
        for (const double x : numbers) squares += (x - mean) * (x - mean);
        return {mean, n > 1.0 ? std::max(least, std::sqrt(squares / (n - 1.0))) : least};
    }

    /// The logarithm of the probability of a number: of the normal distribution from half below to
    /// half above it, among all numbers from 0 on. At least that of 1e-12.
    [[nodiscard]] double log_probability(double number) const {
        constexpr double least = 1e-12;  // numerical: against log(0)
        const double all = 1.0 - below(-0.5);
        return std::log(least + (below(number + 0.5) - below(number - 0.5)) / all);
    }

  private:
    [[nodiscard]] double below(double x) const {
        return 0.5 * std::erfc(-(x - mean) / (deviation * std::numbers::sqrt2));
    }
};

}  // namespace gnomon::recognition
