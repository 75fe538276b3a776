// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <numbers>

#include <gtest/gtest.h>

#include <gnomon/core/detail/part_of_turn.hpp>
#include <gnomon/core/random.hpp>

namespace {

using gnomon::detail::pack;

double part_of_turn(double y, double x) {
    const pack parts = gnomon::detail::part_of_turn(pack(y), pack(x));
    for (std::size_t l = 1; l < pack::size; ++l) EXPECT_EQ(parts[l], parts[0]);
    return parts[0];
}

TEST(part_of_turn, is_that_of_atan2) {
    gnomon::random_stream random(1);
    for (int i = 0; i < 100'000; ++i) {
        const double y = std::ldexp(random.uniform() - 0.5, i % 400 - 200);
        const double x = std::ldexp(random.uniform() - 0.5, (i / 400) % 400 - 200);
        ASSERT_NEAR(part_of_turn(y, x), std::atan2(y, x) / (2.0 * std::numbers::pi), 1e-11)
            << y << ", " << x;
    }
}

TEST(part_of_turn, is_exact_on_the_axes) {
    EXPECT_EQ(part_of_turn(0.0, 0.0), 0.0);
    EXPECT_EQ(part_of_turn(0.0, 3.0), 0.0);
    EXPECT_EQ(part_of_turn(2.0, 0.0), 0.25);
    EXPECT_EQ(part_of_turn(-2.0, 0.0), -0.25);
    EXPECT_EQ(part_of_turn(0.0, -1.0), 0.5);
    EXPECT_EQ(part_of_turn(-0.0, -1.0), 0.5);
}

TEST(part_of_turn, tells_least_angles) {
    for (const double small : {1e-3, 1e-9, 1e-100}) {
        const double part = small / (2.0 * std::numbers::pi);
        EXPECT_NEAR(part_of_turn(small, 1.0) / part, 1.0, 1e-6);
        EXPECT_NEAR(part_of_turn(-small, 1.0) / part, -1.0, 1e-6);
    }
}

}  // namespace
