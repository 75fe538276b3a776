// SPDX-License-Identifier: BSL-1.0
/// @file
/// Tests of normality, of one feature and of whole feature vectors: Anderson-Darling, Mardia's
/// skewness and kurtosis, and the energy test of Szekely and Rizzo. The detection threshold of a
/// word means a probability only as far as its cluster is normal. Klasing 2010, Sec. 5.3.3.
///
///     if (gnomon::recognition::energy_normality(members).rejects(0.05)) ...
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/recognition/detail/chi_squared.hpp>
#include <gnomon/recognition/detail/energy_distance.hpp>
#include <gnomon/recognition/detail/normal_tail.hpp>
#include <gnomon/recognition/detail/samples.hpp>
#include <gnomon/recognition/detail/standardized.hpp>

namespace gnomon::recognition {

/// Whether a test could be made.
enum class test_outcome {
    tested,
    too_few_samples,  ///< fewer than the test is defined for
    degenerate        ///< a constant feature, or one that depends linearly on others
};

/// The result of a test whose null hypothesis is a normal distribution with mean and variance
/// estimated from the samples.
struct normality_test {
    test_outcome outcome = test_outcome::too_few_samples;  ///< whether it was tested
    double statistic = 0.0;                                ///< 0 unless tested
    double p_value = 1.0;                                  ///< 1 unless tested

    /// Whether the null hypothesis is rejected at a significance level.
    [[nodiscard]] bool rejects(double level) const {
        return outcome == test_outcome::tested && p_value <= level;
    }
};

/// The Anderson-Darling test of one variable.
/// @param values  n of them, in any order; at least 8 for a test
/// @return statistic A^2 as it is, p-value of A^2 (1 + 0.75 / n + 2.25 / n^2) by the formulas of
///         Stephens 1986, Table 4.9, the same as those of R's nortest::ad.test
/// @throws std::invalid_argument  if a value is not finite or above 1e100
/// Complexity: O(n log n). Source: Anderson and Darling 1954; Stephens 1986.
[[nodiscard]] inline normality_test anderson_darling(std::span<const double> values) {
    constexpr std::size_t fewest = 8;  // Stephens 1986, Table 4.9
    std::vector<std::array<double, 1>> z(values.size());
    for (std::size_t i = 0; i < z.size(); ++i) z[i] = {values[i]};
    detail::require_usable(z, "anderson_darling: a value is not finite or too large");
    if (z.size() < fewest) return {};
    if (!detail::standardize(z, 1)) return {test_outcome::degenerate};
    std::sort(z.begin(), z.end());
    const auto n = static_cast<double>(z.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < z.size(); ++i) {
        const double below = detail::log_normal_tail(-z[i][0]);
        const double above = detail::log_normal_tail(z[z.size() - 1 - i][0]);
        sum += (2.0 * static_cast<double>(i) + 1.0) * (below + above);
    }
    const double a = -n - sum / n;
    return {test_outcome::tested, a,
            detail::anderson_darling_p_value(a * (1.0 + 0.75 / n + 2.25 / (n * n)))};
}

/// The Anderson-Darling test of each feature of samples.
template <detail::sample_range R>
[[nodiscard]] std::array<normality_test, detail::dimension<R>> anderson_darling(const R& samples) {
    std::array<normality_test, detail::dimension<R>> tests;
    std::vector<double> values(std::size(samples));
    for (std::size_t m = 0; m < tests.size(); ++m) {
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = std::data(samples)[i][m];
        tests[m] = anderson_darling(std::span<const double>(values));
    }
    return tests;
}

/// The two tests of Mardia.
struct mardia_test {
    normality_test skewness;  ///< statistic b_1,p, 0 of a symmetric distribution
    normality_test kurtosis;  ///< statistic b_2,p, D (D + 2) of a normal distribution
};

/// Mardia's tests of multivariate skewness and kurtosis. The p-value of the skewness is that of
/// chi^2 with the correction for small n; that of the kurtosis is two-sided, by the normal
/// distribution with the mean and variance for this n. At a level of 5 %, the skewness rejects 6.3
/// % of normal sample sets of 20 to 100 in three dimensions, 5.5 % of those of 400: measured.
/// @param samples  n of them; at least D + 2 for a test
/// @throws std::invalid_argument  if a value is not finite or above 1e100
/// Complexity: O(n D^3). Source: Mardia 1970; Mardia 1974 for small n.
template <detail::sample_range R>
[[nodiscard]] mardia_test mardia_normality(const R& samples) {
    constexpr std::size_t D = detail::dimension<R>;
    std::vector<std::array<double, D>> y(std::data(samples),
                                         std::data(samples) + std::size(samples));
    detail::require_usable(y, "mardia_normality: a sample is not finite or too large");
    if (y.size() < D + 2) return {};
    const normality_test refused{test_outcome::degenerate};
    if (!detail::standardize(y, 0)) return {refused, refused};
    const auto n = static_cast<double>(y.size());
    constexpr auto p = static_cast<double>(D);
    const auto [b1, b2] = detail::skewness_and_kurtosis(y);
    // Formulas of Mardia 1974.
    const double correction =
        (p + 1.0) * (n + 1.0) * (n + 3.0) / (n * ((n + 1.0) * (p + 1.0) - 6.0));
    const double mean = p * (p + 2.0) * (n - 1.0) / (n + 1.0);
    const double variance = 8.0 * p * (p + 2.0) * (n - 3.0) * (n - p - 1.0) * (n - p + 1.0) /
                            ((n + 1.0) * (n + 1.0) * (n + 3.0) * (n + 5.0));
    const double z = std::abs(b2 - mean) / std::sqrt(variance);
    return {{test_outcome::tested, b1,
             detail::chi_squared_tail(correction * n * b1 / 6.0, D * (D + 1) * (D + 2) / 6)},
            {test_outcome::tested, b2, std::erfc(z / std::numbers::sqrt2)}};
}

/// Options of the energy test.
struct energy_options {
    std::size_t replicates = 199;  ///< normal sample sets for the p-value, at least 1
    std::uint64_t seed = 1;        ///< of these
};

/// The energy test of Szekely and Rizzo, which is consistent against all alternatives: the distance
/// between the distribution of the standardized samples and the standard normal one. Its p-value is
/// that of a parametric bootstrap, (1 + replicates with a statistic at least as large) /
/// (replicates + 1).
/// @param samples  n of them; at least D + 2 for a test
/// @param options  replicates and seed
/// @param run      `sequential{}` or `threads{n}`; the result does not depend on it
/// @throws std::invalid_argument  if a value is not finite or above 1e100, or replicates is 0
/// Complexity: O(n^2 D) for each replicate. Source: Szekely and Rizzo 2005.
template <detail::sample_range R, execution X = sequential>
[[nodiscard]] normality_test energy_normality(const R& samples, const energy_options& options = {},
                                              const X& run = {}) {
    constexpr std::size_t D = detail::dimension<R>;
    using sample_set = std::vector<std::array<double, D>>;
    gnomon::detail::require(options.replicates > 0, "energy_normality: no replicates");
    sample_set y(std::data(samples), std::data(samples) + std::size(samples));
    detail::require_usable(y, "energy_normality: a sample is not finite or too large");
    if (y.size() < D + 2) return {};
    if (!detail::standardize(y, 1)) return {test_outcome::degenerate};
    const double statistic = detail::energy_of_standardized(y);
    std::vector<std::uint8_t> exceeds(options.replicates, 1);
    run(options.replicates, [&](std::size_t r) {
        random_stream random(options.seed, r);
        sample_set normal(y.size());
        for (auto& x : normal)
            for (double& value : x) value = random.gaussian();
        if (detail::standardize(normal, 1))
            exceeds[r] = detail::energy_of_standardized(normal) >= statistic ? 1 : 0;
    });
    const auto larger = static_cast<double>(std::count(exceeds.begin(), exceeds.end(), 1));
    return {test_outcome::tested, statistic,
            (1.0 + larger) / (1.0 + static_cast<double>(options.replicates))};
}

}  // namespace gnomon::recognition
