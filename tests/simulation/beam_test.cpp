// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "simulation/beams.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/beam.hpp>

namespace sim = gnomon::simulation;

namespace {

using beams::ahead, beams::deviation, beams::readings, beams::wall;
using sim::beam, sim::echo;

TEST(beam, widens_as_a_hyperbola) {
    const sim::beam_footprint line;
    EXPECT_TRUE(line.is_line());
    EXPECT_EQ(line.radius(5.0), 0.0);
    const sim::beam_footprint wide{.waist = 0.003,
                                   .divergence = gnomon::radians(2 * std::atan(0.002))};
    EXPECT_FALSE(wide.is_line());
    EXPECT_EQ(wide.radius(0.0), 0.003);
    EXPECT_NEAR(wide.radius(2.0), 0.005, 1e-15);
}

TEST(beam, is_exact_by_default) {
    for (const auto& r : readings(wall{3.3}, {}, 100)) {
        EXPECT_EQ(r.range, 3.3);
        EXPECT_EQ(r.kind, echo::surface);
    }
}

TEST(beam, scatters_by_sigma) {
    for (const double sigma : {0.005, 0.015, 0.030}) {
        EXPECT_NEAR(deviation(readings(wall{3.3}, {.sigma = sigma}, 100'000), 3.3), sigma,
                    0.02 * sigma);
    }
}

TEST(beam, scatters_more_far_away_and_at_grazing_incidence) {
    const beam with_range{.sigma = 0.003, .sigma_per_meter = 0.002};
    EXPECT_NEAR(deviation(readings(wall{4.0}, with_range, 100'000), 4.0), std::hypot(0.003, 0.008),
                0.02 * 0.0085);
    // w = 4 mm; tan(incidence) = sqrt(3).
    const beam grazing{
        .sigma = 0.001,
        .grazing = 1.0,
        .footprint = {.divergence = gnomon::radians(2 * std::atan(0.001)), .sub_rays = 1}};
    const double expected = std::hypot(0.001, 0.5 * 0.004 * std::sqrt(3.0));
    EXPECT_NEAR(deviation(readings(wall{4.0, 0.5}, grazing, 100'000), 4.0), expected,
                0.02 * expected);
}

/// Fig. 2.13: the histogram of readings against the mixture, by chi-square with 40 bins and one
/// more for the maximum range. With twenty tests one falls below p = 0.01 occasionally; none may
/// fall below 0.01 / 20 (76.09 with 40 degrees of freedom), nor the sum of ten below 0.01 (468.7
/// with 400).
TEST(beam, readings_follow_the_mixture) {
    constexpr double max_range = 10.0;
    constexpr int n = 20'000;
    constexpr int bins = 40;
    for (const double truth : {2.0, 6.5}) {
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 10; ++seed) {
            const beam b{.sigma = 0.3, .clutter = 0.2, .failure = 0.1, .seed = seed};
            std::vector<double> count(bins + 1, 0.0);
            for (const auto& r : readings(wall{truth}, b, n, max_range)) {
                if (r.kind == echo::none) {
                    EXPECT_EQ(r.range, max_range);
                    ++count[bins];
                } else {
                    const auto cell = static_cast<std::size_t>(r.range / max_range * bins);
                    ++count[std::min<std::size_t>(cell, bins - 1)];
                }
            }
            const auto below = [&](double r) {
                const double gauss = 0.5 * std::erfc((truth - r) / (0.3 * std::numbers::sqrt2));
                return 0.2 * r / max_range + 0.7 * gauss;
            };
            double chi_square = std::pow(count[bins] - 0.1 * n, 2) / (0.1 * n);
            for (int k = 0; k < bins; ++k) {
                const double expected =
                    n * (below(max_range * (k + 1) / bins) - below(max_range * k / bins));
                chi_square += std::pow(count[static_cast<std::size_t>(k)] - expected, 2) / expected;
            }
            EXPECT_LT(chi_square, 76.09) << "seed " << seed << ", range " << truth;
            sum += chi_square;
        }
        EXPECT_LT(sum, 468.7) << "range " << truth;
    }
}

TEST(beam, fails_where_nothing_is) {
    for (const auto& r : readings(wall{20.0}, {.sigma = 0.01}, 10)) {
        EXPECT_EQ(r.kind, echo::none);
        EXPECT_FALSE(r.hit);
    }
}

/// Noise does not carry a reading beyond what the scanner sees.
TEST(beam, reports_no_range_that_the_scanner_cannot_see) {
    const wall w{2.0};
    const sim::detail::instrument<wall> read(w, {.sigma = 0.3}, 1.8, 2.1);
    int failed = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) {
        gnomon::random_stream random(1, i);
        const auto r = read(ahead, random);
        if (r.kind == echo::none) {
            ++failed;
            continue;
        }
        EXPECT_GE(r.range, 1.8);
        EXPECT_LE(r.range, 2.1);
    }
    EXPECT_NEAR(failed, 2000 * 0.62, 100);  // Phi(-2/3) + 1 - Phi(1/3)
}

TEST(beam, rejects_invalid_parameters) {
    for (const beam& bad :
         {beam{.sigma = -1}, beam{.sigma = clouds::nan}, beam{.sigma = 1e308},
          beam{.sigma_per_meter = -1}, beam{.clutter = -0.1}, beam{.clutter = 0.6, .failure = 0.6},
          beam{.failure = clouds::nan}, beam{.footprint = {.waist = -1}},
          beam{.footprint = {.divergence = gnomon::degrees(180)}},
          beam{.footprint = {.divergence = gnomon::degrees(1), .sub_rays = 0}},
          beam{.footprint = {.divergence = gnomon::degrees(1), .sub_rays = 1'000'000}}}) {
        EXPECT_THROW(bad.require_valid(), std::invalid_argument);
    }
}

}  // namespace
