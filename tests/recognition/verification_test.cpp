// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/recognition/verification.hpp>

namespace {

TEST(verification, states_shares) {
    gnomon::recognition::verification v;
    EXPECT_EQ(v.support(), 0.0);
    EXPECT_EQ(v.explanation(), 0.0);
    EXPECT_EQ(v.observed(), 0.0);
    v.facing = 100;
    v.in_walls = 10;
    v.supported = 30;
    v.seen_through = 20;
    v.mismatched = 10;
    v.hidden = 15;
    v.unobserved = 15;
    v.points = 50;
    v.explained = 40;
    EXPECT_DOUBLE_EQ(v.support(), 3.0 / 7.0);
    EXPECT_DOUBLE_EQ(v.explanation(), 0.8);
    EXPECT_DOUBLE_EQ(v.observed(), 0.6);
    EXPECT_EQ(v.refuted(), 30u);
}

}  // namespace
