// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/core/spectrum.hpp>

namespace {

using gnomon::spectrum;

TEST(spectrum, distinguishes_plane_line_and_ball) {
    EXPECT_DOUBLE_EQ(spectrum({4, 1, 0}).surface_variation(), 0.0);
    EXPECT_DOUBLE_EQ(spectrum({4, 1, 0}).aspect_ratio(), 0.5);
    EXPECT_DOUBLE_EQ(spectrum({9, 9, 9}).surface_variation(), 1.0);
    EXPECT_DOUBLE_EQ(spectrum({9, 0, 0}).aspect_ratio(), 0.0);
    EXPECT_DOUBLE_EQ(spectrum().surface_variation(), 0.0);
    EXPECT_DOUBLE_EQ(spectrum().aspect_ratio(), 0.0);
}

/// docs/thesis-notes.md, A34: sigma_sv = 0.15 with s1 = s2 is s3/s1 = 0.105, lambda3 / sum =
/// 0.0055.
TEST(spectrum, uses_singular_values_and_not_variances) {
    const double s3 = 0.15 * 2 / (3 - 0.15);
    const spectrum s({1, 1, s3 * s3});
    EXPECT_NEAR(s.surface_variation(), 0.15, 1e-15);
    EXPECT_NEAR(s.pauly_variation(), 0.0055, 1e-4);
    EXPECT_NEAR(spectrum::surface_variation_from_pauly(s.pauly_variation()), 0.15, 1e-15);
}

TEST(spectrum, converts_to_the_variation_of_pauly) {
    EXPECT_DOUBLE_EQ(spectrum({5, 4, 1}).pauly_variation(), 0.1);
    EXPECT_DOUBLE_EQ(spectrum({9, 9, 9}).pauly_variation(), 1.0 / 3.0);
    EXPECT_DOUBLE_EQ(spectrum({4, 1, 0}).pauly_variation(), 0.0);
    EXPECT_DOUBLE_EQ(spectrum().pauly_variation(), 0.0);
    EXPECT_DOUBLE_EQ(spectrum({1e308, 1e308, 1e308}).pauly_variation(), 1.0 / 3.0);
}

/// The conversion is exact for every shape, if its aspect ratio is given.
TEST(spectrum, converts_variations) {
    EXPECT_EQ(spectrum::surface_variation_from_pauly(0.0), 0.0);
    EXPECT_DOUBLE_EQ(spectrum::surface_variation_from_pauly(1.0 / 3.0), 1.0);
    for (const double l2 : {1.0, 0.5, 0.01}) {
        for (const double l3 : {0.0, 1e-6, 1e-3, 0.01}) {
            const spectrum s({2.0, 2.0 * l2, 2.0 * l3});
            EXPECT_NEAR(
                spectrum::surface_variation_from_pauly(s.pauly_variation(), s.aspect_ratio()),
                s.surface_variation(), 1e-15);
        }
    }
}

TEST(spectrum, is_scale_invariant_and_clamps_rounding) {
    EXPECT_DOUBLE_EQ(spectrum({3, 2, 1}).surface_variation(),
                     spectrum({3e-8, 2e-8, 1e-8}).surface_variation());
    EXPECT_EQ(spectrum({1, 0.5, -1e-18}).lambda[2], 0.0);
}

}  // namespace
