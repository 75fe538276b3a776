// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/box.hpp>

namespace {

static_assert(gnomon::shape<gnomon::box>);
const gnomon::box chest{0.4, 0.3, 1.2};

TEST(box, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(chest, 1), 1000u); }

TEST(box, agrees_with_its_equation) {
    EXPECT_GT(
        laws::agrees_with_equation(
            chest, 2,
            [](auto x, auto y, auto z) {
                return std::max({std::abs(x) - 0.2L, std::abs(y) - 0.15L, std::abs(z) - 0.6L});
            }),
        1000u);
}

TEST(box, numbers_its_sides) {
    for (int side = 0; side < 6; ++side) {
        Eigen::Vector3d outwards(0, 0, 0);
        outwards[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
        const auto from_outside = chest.first_hit({3.0 * outwards, -outwards});
        ASSERT_TRUE(from_outside);
        EXPECT_EQ(from_outside->surface, side);
        EXPECT_EQ(from_outside->normal, outwards);
        const auto from_inside = chest.first_hit({{0, 0, 0}, outwards});
        ASSERT_TRUE(from_inside);
        EXPECT_EQ(from_inside->surface, side);
        EXPECT_EQ(from_inside->normal, -outwards);
    }
}

TEST(box, may_be_flat) {
    const gnomon::box plate{1.0, 1.0, 0.0};
    const auto hit = plate.first_hit({{0.1, 0.2, 2.0}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->range, 2.0);
    EXPECT_FALSE(plate.first_hit({{-3, 0, 0.1}, {1, 0, 0}}));
}

}  // namespace
