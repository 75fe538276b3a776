// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <stdexcept>

#include <Eigen/Core>
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/normality.hpp>

namespace {

using gnomon::recognition::anderson_darling;
using gnomon::recognition::energy_normality;
using gnomon::recognition::mardia_normality;
using gnomon::recognition::normality_test;
using gnomon::recognition::test_outcome;

/// The generator of Park and Miller 1988, which R evaluates to the same values.
std::vector<double> lehmer_values(std::size_t n, double seed) {
    std::vector<double> v(n);
    for (double& value : v) {
        seed = std::fmod(seed * 16807.0, 2147483647.0);
        value = seed / 2147483647.0;
    }
    return v;
}

std::vector<double> sums_of_twelve(std::size_t n, double seed) {
    const auto v = lehmer_values(12 * n, seed);
    std::vector<double> sums(n, 0.0);
    for (std::size_t i = 0; i < v.size(); ++i) sums[i / 12] += v[i];
    return sums;
}

/// Exponential values in rows of three.
samples::rows<3> lehmer_rows() {
    const auto v = lehmer_values(150, 9);
    samples::rows<3> p(50);
    for (std::size_t i = 0; i < v.size(); ++i) p[i / 3][i % 3] = -std::log(v[i]);
    return p;
}

/// Statistics and p-values of ad.test of the R package nortest 1.0-4, R 4.2.2.
TEST(anderson_darling, is_that_of_nortest) {
    const auto expect = [](const std::vector<double>& v, double statistic, double p) {
        const normality_test t = anderson_darling(v);
        EXPECT_EQ(t.outcome, test_outcome::tested);
        EXPECT_NEAR(t.statistic, statistic, 1e-9 * std::max(1.0, statistic));
        EXPECT_NEAR(t.p_value / p, 1.0, 1e-9);
    };
    auto exponential = lehmer_values(50, 2), logistic = lehmer_values(200, 3);
    for (double& x : exponential) x = -std::log(x);
    for (double& x : logistic) x = std::log(x / (1.0 - x));
    expect(lehmer_values(50, 1), 0.83350138020517761, 0.029390528258442818);
    expect(exponential, 4.2769236492522538, 8.7415482061943882e-11);
    expect(logistic, 1.0028869367114339, 0.01185833949084591);
    expect(sums_of_twelve(100, 4), 0.30840157421117453, 0.55376134590179649);
    expect(sums_of_twelve(8, 5), 0.24876969516612313, 0.64176605143682697);
    auto outlier = lehmer_values(1999, 7);  // 45 standard deviations away
    outlier.push_back(1e6);
    const auto far = anderson_darling(outlier);
    EXPECT_NEAR(far.statistic / 772.2809371064036, 1.0, 1e-9);
    // nortest returns two digits, 3.7e-24, for all corrected statistics of 10 and more.
    EXPECT_NEAR(far.p_value, 3.7e-24, 0.1e-24);
    EXPECT_NEAR(anderson_darling(lehmer_values(1000, 8)).statistic, 11.297698368076681, 1e-8);
}

/// Far from the origin the values themselves lose digits, the test none.
TEST(anderson_darling, does_not_depend_on_units) {
    auto v = sums_of_twelve(30, 6);
    const double there = anderson_darling(v).statistic;
    for (double& x : v) x = 4.8e6 + x;
    EXPECT_NEAR(anderson_darling(v).statistic, there, 1e-7);
    EXPECT_NEAR(anderson_darling(v).statistic, 0.18681277075689096, 1e-9);  // nortest
}

TEST(anderson_darling, tests_each_feature) {
    gnomon::random_stream random(1);
    samples::rows<3> p = samples::gaussian<3>(100, random);
    for (auto& x : p) x = {x[0], std::exp(x[1]), 7.0};
    const auto tests = anderson_darling(p);
    EXPECT_GT(tests[0].p_value, 0.01);
    EXPECT_LT(tests[1].p_value, 1e-6);
    EXPECT_TRUE(tests[1].rejects(0.05));
    EXPECT_EQ(tests[2].outcome, test_outcome::degenerate);
    EXPECT_FALSE(tests[2].rejects(0.05));
}

TEST(log_normal_tail, has_all_digits) {
    using gnomon::recognition::detail::log_normal_tail;
    EXPECT_DOUBLE_EQ(log_normal_tail(0.0), std::log(0.5));
    EXPECT_DOUBLE_EQ(log_normal_tail(-9.0), std::log1p(-0.5 * std::erfc(9.0 / std::sqrt(2.0))));
    // Both sides of the change to the series.
    const double slope = (log_normal_tail(35.0 + 1e-9) - log_normal_tail(35.0 - 1e-9)) / 2e-9;
    EXPECT_NEAR(slope, -35.03, 0.01);
    EXPECT_NEAR(log_normal_tail(36.0) / std::log(0.5 * std::erfc(36.0 / std::sqrt(2.0))), 1.0,
                1e-13);
    EXPECT_TRUE(std::isfinite(log_normal_tail(1e5)));
}

/// b_1 and b_2 by their definition over pairs, in R 4.2.2.
TEST(mardia_normality, is_that_of_the_definition) {
    const auto test = mardia_normality(lehmer_rows());
    EXPECT_NEAR(test.skewness.statistic, 32.574888030807159, 1e-9);
    EXPECT_NEAR(test.kurtosis.statistic, 51.122452861497699, 1e-9);
    EXPECT_LT(test.skewness.p_value, 1e-6);
    EXPECT_LT(test.kurtosis.p_value, 1e-6);
}

/// The statistic by its definition in R 4.2.2, with E|a - Z| by numerical integration.
TEST(energy_normality, is_that_of_the_definition) {
    const auto test = energy_normality(lehmer_rows());
    EXPECT_NEAR(test.statistic, 5.07826244037599, 1e-8);
    EXPECT_DOUBLE_EQ(test.p_value, 1.0 / 200.0);
    using namespace gnomon::recognition::detail;
    const double length = mean_length<3>();
    EXPECT_NEAR(mean_distance_to_normal<3>(0.0, length), 1.59576912160573, 1e-12);
    EXPECT_NEAR(mean_distance_to_normal<3>(2.25, length), 2.13620398583315, 1e-12);
    EXPECT_NEAR(mean_distance_to_normal<3>(36.0, length), 6.16666666664616, 1e-10);
}

/// Kummer's series and the asymptotic one meet where one takes over from the other.
template <std::size_t D>
void expect_series_meet() {
    using namespace gnomon::recognition::detail;
    const double x = std::min(50.0 + static_cast<double>(D * D), 500.0), length = mean_length<D>();
    const double below = mean_distance_to_normal<D>(2.0 * x * (1.0 - 1e-14), length);
    const double above = mean_distance_to_normal<D>(2.0 * x * (1.0 + 1e-14), length);
    EXPECT_NEAR(above / below, 1.0, 1e-12) << D;
}
TEST(energy_normality, both_series_meet) {
    expect_series_meet<1>();
    expect_series_meet<2>();
    expect_series_meet<5>();
    expect_series_meet<12>();
    expect_series_meet<40>();
}

/// All tests on many sample sets: how often each rejects at 5 %.
struct rejection_rates {
    double anderson = 0.0, skewness = 0.0, kurtosis = 0.0, energy = 0.0;
};
rejection_rates rates_of(std::size_t sets, std::size_t n, std::size_t energy_sets,
                         const std::function<double(gnomon::random_stream&)>& value) {
    rejection_rates r;
    for (std::size_t s = 0; s < sets; ++s) {
        gnomon::random_stream random(77, s);
        samples::rows<3> p(n);
        for (auto& x : p)
            for (double& v : x) v = value(random);
        const auto add = [&](double& rate, const normality_test& t, std::size_t of) {
            rate += t.rejects(0.05) ? 1.0 / static_cast<double>(of) : 0.0;
        };
        const auto mardia = mardia_normality(p);
        add(r.anderson, anderson_darling(p)[0], sets);
        add(r.skewness, mardia.skewness, sets);
        add(r.kurtosis, mardia.kurtosis, sets);
        if (s < energy_sets)
            add(r.energy, energy_normality(p, {.replicates = 99, .seed = s}), energy_sets);
    }
    std::printf(
        "rejected at 5 %%: Anderson-Darling %.3f, skewness %.3f, kurtosis %.3f, energy %.3f\n",
        r.anderson, r.skewness, r.kurtosis, r.energy);
    return r;
}

TEST(normality_test, rejects_normal_samples_at_the_significance_level) {
    const auto r = rates_of(4000, 40, 500, [](auto& random) { return random.gaussian(); });
    EXPECT_NEAR(r.anderson, 0.05, 0.012);
    EXPECT_NEAR(r.skewness, 0.063, 0.012);  // chi^2 has a thinner tail than b_1 for small n
    EXPECT_NEAR(r.kurtosis, 0.05, 0.012);
    EXPECT_NEAR(r.energy, 0.05, 0.03);
    const auto many = rates_of(4000, 400, 0, [](auto& random) { return random.gaussian(); });
    EXPECT_NEAR(many.anderson, 0.05, 0.012);
    EXPECT_NEAR(many.skewness, 0.05, 0.012);
    EXPECT_NEAR(many.kurtosis, 0.05, 0.012);
}

TEST(normality_test, rejects_other_distributions) {
    const auto uniform = rates_of(200, 100, 60, [](auto& random) { return random.uniform(); });
    EXPECT_GT(uniform.anderson, 0.8);
    EXPECT_LT(uniform.skewness, 0.1);  // it is symmetric
    EXPECT_GT(uniform.kurtosis, 0.8);
    EXPECT_GT(uniform.energy, 0.7);
    const auto exponential =
        rates_of(200, 50, 60, [](auto& random) { return -std::log(1.0 - random.uniform()); });
    EXPECT_GT(exponential.anderson, 0.95);
    EXPECT_GT(exponential.skewness, 0.95);
    EXPECT_GT(exponential.kurtosis, 0.5);
    EXPECT_GT(exponential.energy, 0.95);
}

TEST(energy_normality, does_not_depend_on_threads_nor_on_units) {
    gnomon::random_stream random(4);
    auto p = samples::correlated<5>(60, 0.1, {}, random);
    const gnomon::recognition::energy_options options{.replicates = 50, .seed = 9};
    const auto one = energy_normality(p, options);
    const auto two = energy_normality(p, options, gnomon::threads{2});
    EXPECT_EQ(one.statistic, two.statistic);
    EXPECT_EQ(one.p_value, two.p_value);
    for (auto& x : p) x = {1e3 * x[0] + x[1], x[1] - x[2], x[2] + 10.0, 0.1 * x[3], x[4] + x[0]};
    const auto turned = energy_normality(p, options);
    EXPECT_NEAR(turned.statistic, one.statistic, 1e-9);
    EXPECT_EQ(turned.p_value, one.p_value);
    EXPECT_NEAR(mardia_normality(p).kurtosis.statistic,
                mardia_normality(samples::rows<5>(p.rbegin(), p.rend())).kurtosis.statistic, 1e-9);
}

void expect_outcome(const samples::rows<2>& p, test_outcome outcome) {
    const auto mardia = mardia_normality(p);
    for (const auto& t : {mardia.skewness, mardia.kurtosis, energy_normality(p)}) {
        EXPECT_EQ(t.outcome, outcome);
        EXPECT_EQ(t.statistic, 0.0);
        EXPECT_EQ(t.p_value, 1.0);
        EXPECT_FALSE(t.rejects(0.05));
    }
}

TEST(normality_test, names_degenerate_samples) {
    gnomon::random_stream random(2);
    auto p = samples::gaussian<2>(30, random);
    expect_outcome({}, test_outcome::too_few_samples);
    expect_outcome({{1, 2}, {2, 3}, {0, 1}}, test_outcome::too_few_samples);
    for (auto& x : p) x[1] = 0.1;
    expect_outcome(p, test_outcome::degenerate);
    for (auto& x : p) x[1] = 3.0 * x[0] + 0.1;
    expect_outcome(p, test_outcome::degenerate);
    expect_outcome(samples::rows<2>(30, {4.8e6, 0.1}), test_outcome::degenerate);
    std::vector<double> rounded(20, 0.1);  // constant up to the last bit
    for (std::size_t i = 0; i < 10; ++i) rounded[i] = std::nextafter(0.1, 1.0);
    EXPECT_EQ(anderson_darling(rounded).outcome, test_outcome::degenerate);
    EXPECT_EQ(anderson_darling(std::vector<double>{}).outcome, test_outcome::too_few_samples);
    EXPECT_EQ(anderson_darling(std::vector<double>(7, 1.0)).outcome, test_outcome::too_few_samples);
    EXPECT_EQ(anderson_darling(std::vector<double>(8, 0.1)).outcome, test_outcome::degenerate);
}

TEST(normality_test, refuses_bad_input) {
    gnomon::random_stream random(2);
    auto p = samples::gaussian<2>(30, random);
    EXPECT_THROW((void)energy_normality(p, {.replicates = 0}), std::invalid_argument);
    p[3][1] = samples::nan;
    EXPECT_THROW((void)energy_normality(p), std::invalid_argument);
    EXPECT_THROW((void)mardia_normality(p), std::invalid_argument);
    EXPECT_THROW((void)anderson_darling(p), std::invalid_argument);
    EXPECT_THROW((void)anderson_darling(std::vector<double>{1.0, samples::infinity}),
                 std::invalid_argument);
}

}  // namespace
