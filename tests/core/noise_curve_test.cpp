// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>

namespace {

using gnomon::constant_noise;
using gnomon::noise_curve;
using gnomon::quadratic_noise;

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

const auto of_a_data_sheet = [](double range) { return range < 10.0 ? 0.01 : 0.001 * range; };

TEST(noise_curve, is_exact_for_polynomials) {
    EXPECT_DOUBLE_EQ(noise_curve(constant_noise{0.02})(7.0), 0.02);
    const quadratic_noise q{0.0015, -0.0005, 0.0003};
    for (const double x : {0.0, 0.4, 1.0, 3.0, 100.0})
        EXPECT_NEAR(noise_curve(q)(x), q(x), 1e-15 + 1e-12 * q(x));
}

TEST(noise_curve, is_near_a_function_with_a_corner_and_constant_beyond_the_table) {
    const noise_curve curve = of_a_data_sheet;
    for (double x = 0.05; x < 500.0; x *= 1.1)
        EXPECT_NEAR(curve(x), of_a_data_sheet(x), 0.04 * curve(x));
    EXPECT_NEAR(curve(0.0), 0.01, 1e-7);
    EXPECT_NEAR(curve(1e9), 0.5, 1e-5);
    EXPECT_NEAR(curve(nan), 0.01, 1e-7);
}

/// An error dz of the depth moves the point by dz / cos along the ray.
TEST(noise_curve, of_the_depth_is_greater_along_oblique_rays) {
    const noise_curve curve{quadratic_noise{0.0, 0.0, 0.001}, {0.0, 0.0, 2.0}};
    EXPECT_TRUE(curve.is_of_depth());
    EXPECT_EQ(curve.axis(), Eigen::Vector3d(0.0, 0.0, 1.0));
    EXPECT_NEAR(curve.along({0.0, 0.0, 3.0}), 0.009, 1e-15);
    EXPECT_NEAR(curve.along({3.0, 0.0, 3.0}), 0.009 * std::sqrt(2.0), 1e-15);
    EXPECT_NEAR(curve.along({0.0, 0.0, -3.0}), 0.009, 1e-15);  // the axis has no sign
    EXPECT_TRUE(std::isfinite(curve.along({1.0, 0.0, 0.0})));
    EXPECT_EQ(curve.along({0.0, 0.0, 0.0}), 0.0);
}

TEST(noise_curve, of_the_range_is_the_same_in_all_directions) {
    const noise_curve curve = quadratic_noise{0.001, 0.001, 0.0};
    EXPECT_FALSE(curve.is_of_depth());
    EXPECT_NEAR(curve.along({3.0, 0.0, 4.0}), 0.006, 1e-15);
}

TEST(noise_curve, is_at_least_the_error_of_rounding_to_a_step) {
    const double step = 0.003;  // at 1 m; with the square of the depth
    const noise_curve curve({1e-8, 0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, step * step / 12.0});
    EXPECT_NEAR(curve.step(2.0), 4.0 * step, 1e-15);
    EXPECT_NEAR(curve(2.0), 4.0 * step / std::sqrt(12.0), 1e-15);
    EXPECT_NEAR(curve(0.1), 1e-4, 1e-15);
    EXPECT_EQ(noise_curve(constant_noise{}).step(1.0), 0.0);
}

/// Independent errors add by their squares, for each kind of curve.
TEST(noise_curve, adds_an_independent_error) {
    const noise_curve of_depth{quadratic_noise{0.0, 0.0, 0.001}, {0.0, 0.0, 2.0}};
    for (const noise_curve& curve :
         {noise_curve(constant_noise{0.02}), noise_curve(quadratic_noise{0.0015, -0.0005, 0.0003}),
          noise_curve(of_a_data_sheet), noise_curve(constant_noise{0.0}), of_depth}) {
        for (const double sigma : {0.0, 0.002, 0.5}) {
            const noise_curve sum = curve.plus(sigma);
            for (const double x : {0.05, 0.4, 3.0, 9.0, 100.0})
                EXPECT_NEAR(sum(x), std::hypot(curve(x), sigma), 1e-12 * sum(x)) << x;
            EXPECT_EQ(sum.is_zero(), curve.is_zero() && sigma == 0.0);
            EXPECT_EQ(sum.is_of_depth(), curve.is_of_depth());
            EXPECT_EQ(sum.axis(), curve.axis());
        }
    }
    EXPECT_NEAR(noise_curve(constant_noise{0.003}).plus(0.004).along({2.0, 0.0, 0.0}), 0.005,
                1e-15);
    for (const double sigma : {-0.001, nan, inf})
        EXPECT_THROW((void)of_depth.plus(sigma), std::invalid_argument) << sigma;
}

/// The step of the readings stays, and what is added is no part of it.
TEST(noise_curve, adds_an_error_to_quantized_readings) {
    const double step = 0.01;
    const noise_curve quantized({1e-8, 0.0, 0.0, 0.0, 0.0},
                                {step * step / 12.0, 0.0, 0.0, 0.0, 0.0});
    const noise_curve sum = quantized.plus(0.002);
    EXPECT_NEAR(sum.step(1.0), step, 1e-15);
    EXPECT_NEAR(sum(1.0), std::hypot(quantized(1.0), 0.002), 1e-15);
}

TEST(noise_curve, is_finite_along_every_finite_ray) {
    for (const noise_curve& curve :
         {noise_curve(quadratic_noise{1e150}), noise_curve(quadratic_noise{0.0, 1e3, 1e3}),
          noise_curve(quadratic_noise{0.0, 0.0, 1e3}, {0.0, 0.0, 1.0}),
          noise_curve([](double x) { return x; })}) {
        for (const double far : {0.0, 1e-200, 1e10, 1e149})
            EXPECT_TRUE(std::isfinite(curve.variance_along({far, 0.0, far}))) << far;
    }
}

TEST(noise_curve, refuses_what_is_no_standard_deviation) {
    EXPECT_THROW((void)noise_curve(constant_noise{1e160}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(constant_noise{-0.01}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(constant_noise{nan}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(constant_noise{inf}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(quadratic_noise{0.01, -0.01, 0.0}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve([](double x) { return 1.0 - x; }), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(noise_curve::quartic{0.0, 0.0, -1.0, 0.0, 0.0}),
                 std::invalid_argument);
    EXPECT_THROW((void)noise_curve(constant_noise{}, {0.0, 0.0, 0.0}), std::invalid_argument);
    EXPECT_THROW((void)noise_curve(constant_noise{}, {nan, 0.0, 1.0}), std::invalid_argument);
}

}  // namespace
