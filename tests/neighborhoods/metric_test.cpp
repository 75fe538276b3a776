// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/metric.hpp>

namespace {

using gnomon::metric;

TEST(metric, is_the_minkowski_distance) {
    gnomon::random_stream random(1);
    for (int i = 0; i < 1000; ++i) {
        const double x = random.uniform(-3, 3), y = random.uniform(-3, 3),
                     z = random.uniform(-3, 3);
        for (const double p : {1.0, 1.5, 2.0, 3.0, 7.0}) {
            const double distance = std::pow(
                std::pow(std::abs(x), p) + std::pow(std::abs(y), p) + std::pow(std::abs(z), p),
                1.0 / p);
            EXPECT_NEAR(metric{p}.squared(x, y, z), distance * distance, 1e-12);
        }
        const double largest = std::max({std::abs(x), std::abs(y), std::abs(z)});
        EXPECT_EQ(metric::maximum().squared(x, y, z), largest * largest);
        EXPECT_EQ(metric::euclidean().squared(x, y, z), x * x + y * y + z * z);
    }
    EXPECT_EQ(metric::manhattan().squared(1, -2, 3), 36.0);
    EXPECT_EQ(metric{3.0}.squared(0, 0, 0), 0.0);
}

/// Powers of the coordinates are out of range, distances are not.
TEST(metric, does_not_overflow) {
    EXPECT_NEAR(metric{300.0}.squared(1e5, 1e5, 0.0) / 1e10, std::pow(2.0, 2.0 / 300.0), 1e-12);
    EXPECT_GT(metric{300.0}.squared(1e-60, 0.0, 0.0), 0.0);
}

TEST(metric, refuses_orders_below_one) {
    EXPECT_THROW(gnomon::detail::require_valid(metric{0.5}), std::invalid_argument);
    EXPECT_THROW(gnomon::detail::require_valid(metric{std::nan("")}), std::invalid_argument);
    EXPECT_NO_THROW(gnomon::detail::require_valid(metric::maximum()));
}

}  // namespace
