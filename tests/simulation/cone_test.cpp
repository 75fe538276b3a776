// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/cone.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::shape<sim::cone>);
const sim::cone marker{0.3, 0.8};

TEST(cone, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(marker, 1), 1000u); }

TEST(cone, agrees_with_its_equation) {
    const auto equation = [](auto x, auto y, auto z) {
        return std::max(
            std::sqrt(x * x + y * y) - (long double)(0.3) * (1 - z / (long double)(0.8)), -z);
    };
    EXPECT_GT(laws::agrees_with_equation(marker, 2, equation), 1000u);
}

TEST(cone, of_no_height_is_a_disc) {
    const sim::cone disc{0.3, 0.0};
    for (const double side : {-1.0, 1.0}) {
        const auto hit = disc.first_hit({{0.1, 0.2, 2.0 * side}, {0, 0, -side}});
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->range, 2.0);
        EXPECT_EQ(hit->normal.z(), side);
        EXPECT_FALSE(disc.first_hit({{0.3, 0.2, 2.0 * side}, {0, 0, -side}}));
    }
}

/// The equation has a second nappe above the apex, which is not there.
TEST(cone, ends_at_its_apex) {
    EXPECT_FALSE(marker.first_hit({{2, 0, 0.9}, {-1, 0, 0}}));
    const auto apex = marker.first_hit({{0, 0, 3}, {0, 0, -1}});
    ASSERT_TRUE(apex);
    EXPECT_NEAR(apex->range, 2.2, 1e-7);
    EXPECT_NEAR(apex->normal.norm(), 1.0, 1e-12);
}

}  // namespace
