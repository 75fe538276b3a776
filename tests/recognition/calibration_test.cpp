// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/calibration.hpp>

namespace rec = gnomon::recognition;

namespace {

/// Views whose true classes have the probabilities softmax(log-likelihoods / temperature).
struct calibration_sample {
    std::vector<std::vector<double>> log_likelihoods;
    std::vector<std::uint32_t> classes;
};

calibration_sample calibration_views(std::size_t n, double temperature, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    calibration_sample s;
    for (std::size_t i = 0; i < n; ++i) {
        std::vector<double> l(3);
        for (double& x : l) x = 2.0 * temperature * random.gaussian();
        const auto p = rec::softmax(l, temperature);
        const double u = random.uniform();
        s.classes.push_back(u < p[0] ? 0 : u < p[0] + p[1] ? 1 : 2);
        s.log_likelihoods.push_back(l);
    }
    return s;
}

double calibration_loss(const calibration_sample& s, double temperature) {
    double loss = 0.0;
    for (std::size_t i = 0; i < s.classes.size(); ++i)
        loss -= std::log(rec::softmax(s.log_likelihoods[i], temperature)[s.classes[i]]);
    return loss;
}

TEST(fit_temperature, finds_the_temperature_of_the_views) {
    for (const double planted : {0.4, 1.0, 3.0, 20.0}) {
        const auto s = calibration_views(4000, planted, 7);
        EXPECT_NEAR(rec::fit_temperature(s.log_likelihoods, s.classes) / planted, 1.0, 0.15);
    }
}

/// Oracle: a finer grid. A step of 5 % is at most 2.5 % from the best.
TEST(fit_temperature, has_the_largest_likelihood) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto s = calibration_views(300, 2.0, seed);
        const double found = rec::fit_temperature(s.log_likelihoods, s.classes);
        double best = 1.0;
        for (double t = 0.3; t < 50.0; t *= 1.002)
            if (calibration_loss(s, t) < calibration_loss(s, best)) best = t;
        EXPECT_NEAR(std::log(found / best), 0.0, 0.028);
    }
}

TEST(fit_temperature, grows_with_the_likelihoods) {
    auto s = calibration_views(500, 1.0, 3);
    const double once = rec::fit_temperature(s.log_likelihoods, s.classes);
    for (auto& l : s.log_likelihoods)
        for (double& x : l) x *= std::exp(0.5);  // ten steps of the grid
    EXPECT_NEAR(rec::fit_temperature(s.log_likelihoods, s.classes) / once, std::exp(0.5), 1e-9);
}

TEST(fit_temperature, ignores_views_without_likelihoods) {
    auto s = calibration_views(200, 2.0, 4);
    const double found = rec::fit_temperature(s.log_likelihoods, s.classes);
    s.log_likelihoods.emplace_back();
    s.classes.push_back(77);
    EXPECT_EQ(rec::fit_temperature(s.log_likelihoods, s.classes), found);
}

/// Nothing was left out: there is no reason to sharpen probabilities.
TEST(fit_temperature, is_one_without_views) {
    EXPECT_DOUBLE_EQ(rec::fit_temperature({}, {}), 1.0);
    const std::vector<std::vector<double>> empty(3);
    EXPECT_DOUBLE_EQ(rec::fit_temperature(empty, std::vector<std::uint32_t>{0, 1, 0}), 1.0);
}

TEST(fit_temperature, refuses_what_is_not_a_number) {
    const double infinity = std::numeric_limits<double>::infinity(), nan = std::nan("");
    const std::vector<std::uint32_t> first{0};
    const auto temperature = [&](double a, double b) {
        const std::vector<std::vector<double>> log_likelihoods{{a, b}};
        return rec::fit_temperature(log_likelihoods, first);
    };
    EXPECT_THROW((void)temperature(nan, 0.0), std::invalid_argument);
    EXPECT_THROW((void)temperature(0.0, nan), std::invalid_argument);
    EXPECT_THROW((void)temperature(0.0, infinity), std::invalid_argument);
    EXPECT_THROW((void)temperature(-infinity, -infinity), std::invalid_argument);
    EXPECT_GT(temperature(0.0, -infinity), 0.0);  // an excluded class
}

TEST(fit_temperature, refuses_what_does_not_fit) {
    const std::vector<std::vector<double>> l{{0.0, 1.0}, {1.0, 0.0}};
    EXPECT_THROW((void)rec::fit_temperature(l, std::vector<std::uint32_t>{0}),
                 std::invalid_argument);
    EXPECT_THROW((void)rec::fit_temperature(l, std::vector<std::uint32_t>{0, 2}),
                 std::invalid_argument);
}

TEST(expected_calibration_error, is_that_of_ten_bins) {
    const std::vector<double> p{0.95, 0.91, 0.55, 0.55, 1.0};
    // Bin 5: 1.1 - 1. Bin 9: 2.86 - 2.
    EXPECT_NEAR(rec::expected_calibration_error(p, {true, false, true, false, true}),
                (0.1 + 0.86) / 5.0, 1e-12);
    EXPECT_EQ(rec::expected_calibration_error({}, {}), 0.0);
    EXPECT_NEAR(rec::expected_calibration_error(std::vector<double>{1.0}, {true}), 0.0, 1e-15);
    EXPECT_NEAR(rec::expected_calibration_error(std::vector<double>{0.0}, {true}), 1.0, 1e-15);
}

TEST(expected_calibration_error, is_small_where_probabilities_are_right) {
    const auto s = calibration_views(5000, 1.0, 11);
    std::vector<double> p;
    std::vector<bool> is_right;
    for (std::size_t i = 0; i < s.classes.size(); ++i) {
        const auto q = rec::softmax(s.log_likelihoods[i]);
        const auto best = std::max_element(q.begin(), q.end()) - q.begin();
        p.push_back(q[static_cast<std::size_t>(best)]);
        is_right.push_back(static_cast<std::uint32_t>(best) == s.classes[i]);
    }
    EXPECT_LT(rec::expected_calibration_error(p, is_right), 0.02);
}

TEST(expected_calibration_error, refuses_what_does_not_fit) {
    EXPECT_THROW((void)rec::expected_calibration_error(std::vector<double>{0.5}, {}),
                 std::invalid_argument);
    for (const double p : {-0.1, 1.1, std::nan("")})
        EXPECT_THROW((void)rec::expected_calibration_error(std::vector<double>{p}, {true}),
                     std::invalid_argument);
}

}  // namespace
