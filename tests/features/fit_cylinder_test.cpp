// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "features/range_oracle.hpp"
#include "features/round_samples.hpp"
#include "laws/clouds.hpp"
#include <gnomon/features/fit_cylinder.hpp>

namespace {

constexpr auto a_cylinder = round_samples::kind::cylinder;

TEST(fit_cylinder, is_exact_without_noise) {
    EXPECT_LT(round_samples::largest_error<a_cylinder>(false), 1e-11);
    EXPECT_LT(round_samples::largest_error<a_cylinder>(true), 1e-11);
}

/// 2,000 draws, arcs of 90 to 360 degrees: the covariance is that of the errors.
TEST(fit_cylinder, covariance_holds_for_noise_in_all_directions) {
    int failed = 0;
    const double nees =
        round_samples::nees<a_cylinder>({.sigma = 0.01}, 2.0 * std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);  // .3 % are expected
}

/// The same for one side, seen from five radii.
TEST(fit_cylinder, covariance_holds_for_noise_along_rays) {
    int failed = 0;
    const double nees = round_samples::nees<a_cylinder>({.sigma = 0.01, .along_rays = true},
                                                        std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);
}

/// An independent minimizer of the residuals in ranges finds the same parameters.
TEST(fit_cylinder, is_the_least_squares_fit_of_ranges) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const round_samples::drawing d{
            .arc = 0.5 * std::numbers::pi, .sigma = 0.02, .along_rays = true};
        const auto s = round_samples::draw<a_cylinder>(d, seed);
        const auto e = gnomon::fit_cylinder(s.viewed(), s.surface, gnomon::constant_noise{d.sigma});
        ASSERT_EQ(e.points, s.points.size());
        range_oracle::expect_minimum(e, s, d.sigma);
    }
}

/// A pole that is seen from one side, with a deviation of a third of its radius, as poles are.
TEST(fit_cylinder, fits_thin_poles) {
    int good = 0;
    double sum = 0.0;
    constexpr int draws = 200;
    for (int i = 0; i < draws; ++i) {
        const round_samples::drawing d{
            .radius = 0.05, .height = 40.0, .sigma = 0.15, .points = 400, .along_rays = true};
        const auto s = round_samples::draw<a_cylinder>(d, static_cast<std::uint64_t>(i));
        const auto e =
            gnomon::fit_cylinder(s.viewed(), s.surface, gnomon::constant_noise{d.sigma * d.radius});
        good += e.status == round_samples::outcome::good;
        sum += (e.radius - d.radius) / std::sqrt(e.covariance(4, 4));
    }
    EXPECT_GT(good, 0.9 * draws);
    EXPECT_LT(std::abs(sum / draws), 1.5);
}

/// Points on a sphere are not on a cylinder.
TEST(fit_cylinder, is_poor_for_a_sphere) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto s = round_samples::draw<round_samples::kind::sphere>({.sigma = 0.01}, seed);
        const auto e = gnomon::fit_cylinder(s.points, s.surface, gnomon::constant_noise{0.01});
        EXPECT_EQ(e.status, round_samples::outcome::poor_fit);
    }
}

}  // namespace
