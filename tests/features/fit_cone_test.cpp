// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "features/range_oracle.hpp"
#include "features/round_samples.hpp"
#include "laws/clouds.hpp"
#include <gnomon/features/fit_cone.hpp>

namespace {

constexpr auto a_cone = round_samples::kind::cone;

TEST(fit_cone, is_exact_without_noise) {
    EXPECT_LT(round_samples::largest_error<a_cone>(false), 1e-11);
    EXPECT_LT(round_samples::largest_error<a_cone>(true), 1e-11);
}

/// 2,000 draws, arcs of 90 to 360 degrees: the covariance is that of the errors.
TEST(fit_cone, covariance_holds_for_noise_in_all_directions) {
    int failed = 0;
    const double nees =
        round_samples::nees<a_cone>({.sigma = 0.01}, 2.0 * std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);  // .3 % are expected
}

/// The same for one side, seen from five radii.
TEST(fit_cone, covariance_holds_for_noise_along_rays) {
    int failed = 0;
    const double nees =
        round_samples::nees<a_cone>({.sigma = 0.01, .along_rays = true}, std::numbers::pi, failed);
    EXPECT_NEAR(nees, 1.0, round_samples::draws.off);
    EXPECT_LT(failed, round_samples::draws.failed);
}

/// An independent minimizer of the residuals in ranges finds the same parameters.
TEST(fit_cone, is_the_least_squares_fit_of_ranges) {
    for (std::uint64_t seed = 0; seed < 10; ++seed) {
        const round_samples::drawing d{
            .arc = 0.5 * std::numbers::pi, .sigma = 0.02, .along_rays = true};
        const auto s = round_samples::draw<a_cone>(d, seed);
        const auto e = gnomon::fit_cone(s.viewed(), s.surface, gnomon::constant_noise{d.sigma});
        ASSERT_EQ(e.points, s.points.size());
        range_oracle::expect_minimum(e, s, d.sigma);
    }
}

TEST(fit_cone, finds_the_apex) {
    const round_samples::drawing d;
    const auto s = round_samples::draw<a_cone>(d, 1);
    const auto e = gnomon::fit_cone(s.points, s.surface, gnomon::constant_noise{0.01});
    const Eigen::Vector3d apex = s.center - s.axis() / std::tan(d.half_angle);
    EXPECT_LT((e.apex() - apex).norm(), 1e-9);
    EXPECT_GT(e.direction().dot(s.axis()), 0.999999);  // away from the apex
}

/// A cylinder is a cone whose half-angle is 0 within its deviation.
TEST(fit_cone, fits_cylinders) {
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        const auto s = round_samples::draw<round_samples::kind::cylinder>({.sigma = 0.01}, seed);
        const auto e = gnomon::fit_cone(s.points, s.surface, gnomon::constant_noise{0.01});
        ASSERT_TRUE(e.has_parameters());
        EXPECT_LT(e.half_angle.radians(), 4.0 * std::sqrt(e.covariance(5, 5)));
        EXPECT_TRUE(e.apex().allFinite());
    }
}

}  // namespace
