// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>

namespace {

/// The expected values were computed from the formulas in another programming language.
TEST(random_stream, is_the_same_on_every_platform) {
    EXPECT_EQ(gnomon::random_stream(42, 7).bits(), 4191941099297208311u);
}

TEST(random_stream, differs_by_seed_and_by_stream) {
    gnomon::random_stream a(1, 0), b(2, 0), c(1, 1), again(1, 0);
    const std::uint64_t first = a.bits();
    EXPECT_NE(first, b.bits());
    EXPECT_NE(first, c.bits());
    EXPECT_EQ(first, again.bits());
}

/// Mean and variance over the first numbers of many streams, as the simulated scanner uses them.
TEST(random_stream, has_the_moments_of_its_distributions_across_streams) {
    constexpr int n = 200'000;
    double u1 = 0, u2 = 0, g1 = 0, g2 = 0, g4 = 0;
    for (std::uint64_t s = 0; s < n; ++s) {
        gnomon::random_stream random(9, s);
        const double u = random.uniform();
        const double g = random.gaussian();
        ASSERT_GE(u, 0.0);
        ASSERT_LT(u, 1.0);
        u1 += u, u2 += u * u, g1 += g, g2 += g * g, g4 += g * g * g * g;
    }
    // Five standard errors each.
    EXPECT_NEAR(u1 / n, 0.5, 5 * std::sqrt(1.0 / 12 / n));
    EXPECT_NEAR(u2 / n, 1.0 / 3, 5 * std::sqrt(4.0 / 45 / n));
    EXPECT_NEAR(g1 / n, 0.0, 5 * std::sqrt(1.0 / n));
    EXPECT_NEAR(g2 / n, 1.0, 5 * std::sqrt(2.0 / n));
    EXPECT_NEAR(g4 / n, 3.0, 5 * std::sqrt(96.0 / n));
}

}  // namespace
