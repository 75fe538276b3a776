// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"
#include <gnomon/recognition/weighted_distance.hpp>

namespace {

using gnomon::recognition::difference_sum;
using gnomon::recognition::weighted_distance;

TEST(weighted_distance, is_a_metric_scaled_to_the_unit_cube) {
    const weighted_distance<5> rho{{.30, .30, .13, .13, .13}};  // their sum is 0.99
    EXPECT_DOUBLE_EQ(rho({0, 0, 0, 0, 0}, {1, 1, 1, 1, 1}), 1.0);
    EXPECT_DOUBLE_EQ(rho({0, 0, 0, 0, 0}, {.1, -.1, .1, -.1, .1}), 0.1);
    gnomon::random_stream random(1);
    for (int i = 0; i < 200; ++i) {
        const auto p = samples::gaussian<5>(3, random);
        EXPECT_EQ(rho(p[0], p[1]), rho(p[1], p[0]));
        EXPECT_EQ(rho(p[0], p[0]), 0.0);
        EXPECT_LE(rho(p[0], p[2]), rho(p[0], p[1]) + rho(p[1], p[2]) + 1e-15);
    }
}

TEST(weighted_distance, weighs_features) {
    const weighted_distance<2> rho{{3.0, 1.0}};
    EXPECT_DOUBLE_EQ(rho({0, 0}, {1, 0}), 0.75);
    EXPECT_DOUBLE_EQ(rho({0, 0}, {0, -1}), 0.25);
    EXPECT_DOUBLE_EQ(weighted_distance<4>{}({0, 0, 0, 0}, {1, 0, 0, 0}), 0.25);
}

/// Eq. (5.2) as it is printed: differences of opposite signs cancel, and 1 / n_f is applied to
/// normalized weights.
TEST(weighted_distance, as_printed) {
    const weighted_distance<2> rho{{1.0, 1.0}, difference_sum::as_printed};
    EXPECT_EQ(rho({0, 0}, {1, -1}), 0.0);
    EXPECT_DOUBLE_EQ(rho({0, 0}, {-1, -1}), 0.5);
}

TEST(weighted_distance, refuses_weights) {
    using rho = weighted_distance<2>;
    EXPECT_NO_THROW((rho{{0.0, 2.0}}.require_weights()));
    EXPECT_THROW((rho{{-0.1, 1.0}}.require_weights()), std::invalid_argument);
    EXPECT_THROW((rho{{0.0, 0.0}}.require_weights()), std::invalid_argument);
    EXPECT_THROW((rho{{samples::nan, 1.0}}.require_weights()), std::invalid_argument);
    EXPECT_THROW((rho{{samples::infinity, 1.0}}.require_weights()), std::invalid_argument);
}

}  // namespace
