// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <gtest/gtest.h>

#include "laws/range_noise_laws.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/range_noise.hpp>

TEST(range_noise, laws) {
    const auto obeys = [](const auto& noise) {
        laws::is_a_standard_deviation(noise);
        laws::converts_to_a_curve(noise);
    };
    obeys(gnomon::constant_noise{});
    obeys(gnomon::constant_noise{0.0});
    obeys(gnomon::quadratic_noise{0.001, 0.002, 0.003});
    obeys(gnomon::noises::structured_light());
    obeys(gnomon::noises::time_of_flight());
    obeys(gnomon::noises::stereo());
    obeys(gnomon::noise_curve(gnomon::noises::stereo(), {0.0, 0.0, 1.0}));
    obeys([](double range) { return 0.002 + 0.0005 * std::pow(range, 1.5); });
    obeys([](double) { return 0.0; });
}

/// Figures of the papers.
TEST(range_noise, of_cameras_is_that_of_the_literature) {
    EXPECT_NEAR(gnomon::noises::structured_light()(0.4), 0.0012, 1e-12);
    EXPECT_NEAR(gnomon::noises::structured_light()(3.4), 0.0012 + 0.0019 * 9.0, 1e-12);
    EXPECT_NEAR(gnomon::noises::time_of_flight()(2.0), 0.0017, 1e-12);
    EXPECT_NEAR(gnomon::noises::stereo(0.08, 1000.0, 0.05)(2.0), 0.08 * 4.0 / 50.0, 1e-12);
}
