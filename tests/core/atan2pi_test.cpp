// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include <gnomon/core/detail/atan2pi.hpp>
#include <gnomon/core/random.hpp>

namespace {

using gnomon::detail::atan2pi, gnomon::detail::pack;

double of_one(double y, double x) { return atan2pi(pack(y), pack(x))[0]; }

TEST(atan2pi, is_atan2_over_pi) {
    gnomon::random_stream random(1);
    for (int i = 0; i < 20'000; ++i) {
        std::array<double, pack::size> y, x;
        for (std::size_t l = 0; l < pack::size; ++l) {
            y[l] = std::ldexp(random.uniform() - 0.5, i % 400 - 200);
            x[l] = std::ldexp(random.uniform() - 0.5, i / 400 * 8 - 200);
        }
        const pack angles = atan2pi(pack(y.data()), pack(x.data()));
        for (std::size_t l = 0; l < pack::size; ++l)
            ASSERT_NEAR(angles[l], std::atan2(y[l], x[l]) / std::numbers::pi, 2e-11)
                << y[l] << ", " << x[l];
    }
}

TEST(atan2pi, is_exact_on_the_axes) {
    EXPECT_EQ(of_one(0.0, 0.0), 0.0);
    EXPECT_EQ(of_one(0.0, 3.0), 0.0);
    EXPECT_EQ(of_one(2.0, 0.0), 0.5);
    EXPECT_EQ(of_one(2.0, -0.0), 0.5);
    EXPECT_EQ(of_one(-2.0, 0.0), -0.5);
    EXPECT_EQ(of_one(0.0, -1.0), 1.0);
    EXPECT_EQ(of_one(-0.0, -1.0), 1.0);
}

TEST(atan2pi, is_continuous_between_octants) {
    for (const double x : {-1.0, 1.0}) {
        for (const double y : {-1.0, 1.0}) {
            const double expected = std::atan2(y, x) / std::numbers::pi;
            for (const double beside : {1.0 - 1e-15, 1.0, 1.0 + 1e-15})
                EXPECT_NEAR(of_one(y * beside, x), expected, 2e-11);
        }
    }
}

TEST(atan2pi, keeps_small_angles) {
    for (const double small : {1e-3, 1e-9, 1e-100}) {
        EXPECT_NEAR(of_one(small, 1.0) * std::numbers::pi / small, 1.0, 1e-6);
        EXPECT_NEAR(of_one(-small, 1.0) * std::numbers::pi / small, -1.0, 1e-6);
    }
}

}  // namespace
