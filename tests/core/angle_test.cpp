// SPDX-License-Identifier: BSL-1.0
#include <concepts>
#include <numbers>
#include <type_traits>

#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>

TEST(angle, has_units) {
    EXPECT_DOUBLE_EQ(gnomon::degrees(180).radians(), std::numbers::pi);
    EXPECT_DOUBLE_EQ(gnomon::radians(std::numbers::pi / 2).degrees(), 90.0);
    EXPECT_LT(gnomon::degrees(5), gnomon::radians(1));
    EXPECT_NEAR(cos(gnomon::degrees(60)), 0.5, 1e-15);
    EXPECT_NEAR(sin(gnomon::degrees(30)), 0.5, 1e-15);
    EXPECT_EQ(gnomon::angle{}, gnomon::radians(0));
}

TEST(angle, is_not_constructible_from_a_number) {
    static_assert(!std::convertible_to<double, gnomon::angle>);
    static_assert(!std::is_constructible_v<gnomon::angle, double>);
}
