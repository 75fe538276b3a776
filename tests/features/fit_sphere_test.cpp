// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "features/range_oracle.hpp"
#include "features/round_samples.hpp"
#include "laws/clouds.hpp"
#include <gnomon/features/fit_sphere.hpp>

namespace {

constexpr auto a_sphere = round_samples::kind::sphere;

TEST(fit_sphere, is_exact_without_noise) {
    EXPECT_LT(round_samples::largest_error<a_sphere>(false), 1e-11);
    EXPECT_LT(round_samples::largest_error<a_sphere>(true), 1e-11);
}

/// 2,000 draws, arcs of 90 to 360 degrees: the covariance is that of the errors.
TEST(fit_sphere, covariance_holds_for_noise_in_all_directions) {
    int failed = 0;
    const double nees =
        round_samples::nees<a_sphere>({.sigma = 0.01}, 2.0 * std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);  // .3 % are expected
}

/// The same for one side, seen from five radii.
TEST(fit_sphere, covariance_holds_for_noise_along_rays) {
    int failed = 0;
    const double nees = round_samples::nees<a_sphere>({.sigma = 0.01, .along_rays = true},
                                                      std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);
}

/// An independent minimizer of the residuals in ranges finds the same parameters.
TEST(fit_sphere, is_the_least_squares_fit_of_ranges) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const round_samples::drawing d{
            .arc = 0.5 * std::numbers::pi, .sigma = 0.02, .along_rays = true};
        const auto s = round_samples::draw<a_sphere>(d, seed);
        const auto e = gnomon::fit_sphere(s.viewed(), s.surface, gnomon::constant_noise{d.sigma});
        ASSERT_EQ(e.points, s.points.size());
        range_oracle::expect_minimum(e, s, d.sigma);
    }
}

/// Noise in all directions displaces the mean distance from a sphere by sigma^2 / R.
TEST(fit_sphere, has_no_bias_for_large_noise) {
    double sum = 0.0;
    constexpr int draws = 100;
    const double sigma = 0.05;
    for (int i = 0; i < draws; ++i) {
        const auto s = round_samples::draw<a_sphere>(
            {.arc = 2.0 * std::numbers::pi, .sigma = sigma, .points = 500},
            static_cast<std::uint64_t>(i));
        sum += gnomon::fit_sphere(s.points, s.surface, gnomon::constant_noise{sigma}).radius - 1.0;
    }
    EXPECT_LT(std::abs(sum / draws), 0.3 * sigma * sigma);
}

/// At UTM coordinates the radius is as exact as the coordinates, whose rounding is .5 nm.
TEST(fit_sphere, is_exact_at_utm_coordinates) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto s =
            round_samples::draw<a_sphere>({.arc = 0.5 * std::numbers::pi}, seed, {4e5, 5e6, 100.0});
        const auto e = gnomon::fit_sphere(s.points, s.surface, gnomon::constant_noise{0.01});
        EXPECT_NEAR(e.radius, 1.0, 1e-9);
        EXPECT_LT((e.center - s.center).norm(), 2e-9);
    }
}

/// A circle is on many spheres.
TEST(fit_sphere, is_degenerate_for_points_on_a_circle) {
    clouds::cloud circle;
    for (int i = 0; i < 50; ++i) circle.push_back({std::cos(0.1 * i), std::sin(0.1 * i), 0.3});
    std::vector<round_samples::element> surface;
    for (const auto& p : circle) surface.push_back({p});
    const auto e = gnomon::fit_sphere(circle, surface, gnomon::constant_noise{0.01});
    EXPECT_EQ(e.status, round_samples::outcome::degenerate);
}

}  // namespace
