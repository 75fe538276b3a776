// SPDX-License-Identifier: BSL-1.0
/// @file
/// Calibration of probabilities: of the views that a classifier is 90 % certain of, 90 % should be
/// right. A temperature divides all log-likelihoods (Guo et al. 2017).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/recognition/posterior.hpp>

namespace gnomon::recognition {

/// The temperature under which the true classes have the largest likelihood, on a grid from 1/4 to
/// 55 in steps of 5 %.
/// @param log_likelihoods  of views that were not learned, for every class; empty ones are ignored;
/// without any, it is 1
/// @param classes          the true class of each view
/// @throws std::invalid_argument  if they differ in number, a class is too large, or
///                                log-likelihoods are NaN or exclude every class
/// Complexity: O(n * classes) for n views.
[[nodiscard]] inline double fit_temperature(std::span<const std::vector<double>> log_likelihoods,
                                            std::span<const std::uint32_t> classes) {
    gnomon::detail::require(log_likelihoods.size() == classes.size(),
                            "fit_temperature: views and classes differ in number");
    if (std::all_of(log_likelihoods.begin(), log_likelihoods.end(),
                    [](const auto& l) { return l.empty(); }))
        return 1.0;
    for (std::size_t i = 0; i < classes.size(); ++i) {
        const auto& l = log_likelihoods[i];
        if (l.empty()) continue;
        gnomon::detail::require(classes[i] < l.size(), "fit_temperature: a class is too large");
        const double largest = *std::max_element(l.begin(), l.end());
        gnomon::detail::require(
            std::isfinite(largest) &&
                std::all_of(l.begin(), l.end(), [&](double x) { return x <= largest; }),
            "fit_temperature: log-likelihoods are NaN, or exclude every class");
    }
    constexpr double step = 0.05, least = 1e-300;  // the latter, numerical: against log(0)
    double best = 1.0, best_loss = std::numeric_limits<double>::infinity();
    for (int k = -28; k <= 80; ++k) {
        const double temperature = std::exp(step * k);
        double loss = 0.0;
        for (std::size_t i = 0; i < classes.size(); ++i) {
            if (log_likelihoods[i].empty()) continue;
            const auto p = softmax(log_likelihoods[i], temperature);
            loss -= std::log(std::max(least, p[classes[i]]));
        }
        if (loss < best_loss) {
            best_loss = loss;
            best = temperature;
        }
    }
    return best;
}

/// The expected calibration error: the mean difference between the probability of the best class
/// and the share of views in which it is right, over ten bins of equal width (Naeini, Cooper and
/// Hauskrecht 2015).
/// @param probability  of the best class of each view, in [0, 1]
/// @param is_right     whether it is the true one
/// @throws std::invalid_argument  if they differ in number, or a probability is not in [0, 1]
[[nodiscard]] inline double expected_calibration_error(std::span<const double> probability,
                                                       const std::vector<bool>& is_right) {
    gnomon::detail::require(probability.size() == is_right.size(),
                            "expected_calibration_error: the numbers of views differ");
    constexpr std::size_t bins = 10;
    std::array<double, bins> excess{};
    for (std::size_t i = 0; i < probability.size(); ++i) {
        gnomon::detail::require(probability[i] >= 0.0 && probability[i] <= 1.0,
                                "expected_calibration_error: a probability is not in [0, 1]");
        const auto bin = std::min(bins - 1, static_cast<std::size_t>(probability[i] * 10.0));
        excess[bin] += probability[i] - (is_right[i] ? 1.0 : 0.0);
    }
    double sum = 0.0;
    for (const double e : excess) sum += std::abs(e);
    return probability.empty() ? 0.0 : sum / static_cast<double>(probability.size());
}

}  // namespace gnomon::recognition
