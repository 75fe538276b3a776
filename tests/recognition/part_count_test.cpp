// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/recognition/part_count.hpp>

using gnomon::recognition::part_count;

namespace {

/// docs/thesis-notes.md, A29: the probabilities of all numbers from 0 on.
TEST(part_count, sums_to_one_over_the_numbers) {
    for (const double mean : {0.0, 0.3, 2.0, 7.5, 30.0}) {
        for (const double deviation : {0.5, 1.0, 6.0}) {
            double sum = 0.0;
            for (int n = 0; n < 200; ++n)
                sum += std::exp(part_count{mean, deviation}.log_probability(n));
            EXPECT_NEAR(sum, 1.0, 1e-9) << mean << " " << deviation;
        }
    }
}

/// Oracle: the integral of the density by Simpson's rule.
TEST(part_count, is_the_integral_of_the_density) {
    const part_count count{3.2, 1.7};
    const auto integral = [&](double low, double high) {
        const auto f = [&](double x) {
            return std::exp(-0.5 * std::pow((x - 3.2) / 1.7, 2)) / (1.7 * std::sqrt(2.0 * M_PI));
        };
        const int steps = 4000;
        const double h = (high - low) / steps;
        double sum = f(low) + f(high);
        for (int i = 1; i < steps; ++i) sum += (i % 2 == 1 ? 4.0 : 2.0) * f(low + i * h);
        return sum * h / 3.0;
    };
    for (int n = 0; n < 9; ++n) {
        EXPECT_NEAR(std::exp(count.log_probability(n)),
                    integral(n - 0.5, n + 0.5) / integral(-0.5, 40.0), 1e-10);
    }
}

TEST(part_count, has_the_mean_and_the_sample_deviation) {
    const auto count = part_count::of(std::vector<double>{2.0, 4.0, 9.0});
    EXPECT_DOUBLE_EQ(count.mean, 5.0);
    EXPECT_DOUBLE_EQ(count.deviation, std::sqrt(13.0));
}

TEST(part_count, does_not_exclude_the_neighbors_of_a_number_that_was_always_the_same) {
    for (const auto& numbers : {std::vector<double>{4.0, 4.0, 4.0}, std::vector<double>{4.0}}) {
        const auto count = part_count::of(numbers);
        EXPECT_EQ(count.mean, 4.0);
        EXPECT_EQ(count.deviation, 0.5);
        EXPECT_GT(std::exp(count.log_probability(5.0)), 0.1);
        EXPECT_GT(count.log_probability(4.0), count.log_probability(5.0));
        EXPECT_NEAR(count.log_probability(5.0), count.log_probability(3.0), 1e-9);
    }
}

TEST(part_count, is_finite_for_any_number) {
    for (const double n : {0.0, 1e3, 1e9}) {
        EXPECT_TRUE(std::isfinite(part_count::of({}).log_probability(n)));
        EXPECT_GE((part_count{5.0, 0.5}.log_probability(n)), std::log(1e-12) - 1e-9);
    }
}

}  // namespace
