// SPDX-License-Identifier: BSL-1.0
/// @file
/// Samples with zero mean and unit covariance, and their third and fourth moments.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/recognition/cluster.hpp>
#include <gnomon/recognition/detail/cholesky.hpp>

namespace gnomon::recognition::detail {

/// Replaces samples by L^-1 (x - mean), where L L^T is their scatter / (n - lost): their covariance
/// for `lost` = 1, that of maximum likelihood for 0. Computed about the first sample, then about
/// their mean, so that samples far from the origin keep their digits.
/// @return whether the covariance is regular, beyond the rounding of the samples; else the samples
///         are unspecified
template <std::size_t D>
[[nodiscard]] bool standardize(std::vector<std::array<double, D>>& samples, std::size_t lost) {
    constexpr double rounding = 1e-14;  // numerical: of a value, in a few of its last bits
    cluster_statistics<D> rough, exact;
    const auto move = [&](const std::array<double, D> by) {
        for (auto& x : samples)
            for (std::size_t i = 0; i < D; ++i) x[i] -= by[i];
    };
    std::array<double, D> largest{};
    for (const auto& x : samples)
        for (std::size_t i = 0; i < D; ++i) largest[i] = std::max(largest[i], std::abs(x[i]));
    move(samples.front());
    for (const auto& x : samples) rough.add(x);
    move(rough.mean);
    for (const auto& x : samples) exact.add(x);
    square_array<D> covariance = exact.scatter;
    for (std::size_t i = 0; i < D; ++i) {
        for (std::size_t j = 0; j < D; ++j)
            covariance[i][j] /= static_cast<double>(samples.size() - lost);
        if (!(std::sqrt(covariance[i][i]) > rounding * largest[i])) return false;
    }
    const cholesky<D> factor(covariance);
    if (!factor.is_positive_definite()) return false;
    for (auto& x : samples) x = factor.whitened(x);
    return true;
}

/// Mardia's b_1 and b_2.
struct mardia_moments {
    double skewness;  ///< sum of the squares of all third moments
    double kurtosis;  ///< mean of |y|^4
};

/// Of standardized samples. O(n D^3): the definition of b_1 as a mean over pairs of samples,
/// (y_i . y_j)^3, is the sum of the squares of the third moments.
template <std::size_t D>
[[nodiscard]] mardia_moments skewness_and_kurtosis(const std::vector<std::array<double, D>>& y) {
    const auto n = static_cast<double>(y.size());
    mardia_moments b{};
    std::array<square_array<D>, D> third{};
    for (const auto& x : y) {
        double squared = 0.0;
        for (std::size_t i = 0; i < D; ++i) {
            squared += x[i] * x[i];
            for (std::size_t j = 0; j < D; ++j)
                for (std::size_t k = 0; k < D; ++k) third[i][j][k] += x[i] * x[j] * x[k];
        }
        b.kurtosis += squared * squared / n;
    }
    for (const auto& plane : third)
        for (const auto& row : plane)
            for (const double entry : row) b.skewness += (entry / n) * (entry / n);
    return b;
}

}  // namespace gnomon::recognition::detail
