// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/recognition/vertical_symmetry.hpp>

namespace {

namespace rec = gnomon::recognition;
using gnomon::degrees;

TEST(vertical_symmetry, measures_differences_of_yaws) {
    using rec::vertical_symmetry;
    const auto off = [](int order, double a, double b) {
        return vertical_symmetry{.order = order}.difference(degrees(a), degrees(b)).degrees();
    };
    EXPECT_NEAR(off(1, 170, -170), 20.0, 1e-9);
    EXPECT_NEAR(off(2, 170, -20), 10.0, 1e-9);
    EXPECT_NEAR(off(4, 100, 5), 5.0, 1e-9);
    EXPECT_EQ(off(vertical_symmetry::any_turn, 100, 5), 0.0);
    const vertical_symmetry s{.order = 2, .x = 1.0, .y = 2.0};
    EXPECT_LT((s.turn(degrees(180)).point_out({2, 2, 7}) - Eigen::Vector3d(0, 2, 7)).norm(), 1e-12);
}

}  // namespace
