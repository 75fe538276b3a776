// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/simulation/beam.hpp>

namespace {

using gnomon::beam;

TEST(beam, widens_as_a_hyperbola) {
    const gnomon::beam_footprint line;
    EXPECT_TRUE(line.is_line());
    EXPECT_EQ(line.radius(5.0), 0.0);
    const gnomon::beam_footprint wide{.waist = 0.003,
                                      .divergence = gnomon::radians(2 * std::atan(0.002))};
    EXPECT_FALSE(wide.is_line());
    EXPECT_EQ(wide.radius(0.0), 0.003);
    EXPECT_NEAR(wide.radius(2.0), 0.005, 1e-15);
}

TEST(beam, refuses_what_cannot_be) {
    for (const beam& bad :
         {beam{.sigma = -1}, beam{.sigma = clouds::nan}, beam{.sigma = 1e308},
          beam{.sigma_per_meter = -1}, beam{.clutter = -0.1}, beam{.clutter = 0.6, .failure = 0.6},
          beam{.failure = clouds::nan}, beam{.footprint = {.waist = -1}},
          beam{.footprint = {.divergence = gnomon::degrees(180)}},
          beam{.footprint = {.divergence = gnomon::degrees(1), .sub_rays = 0}},
          beam{.footprint = {.divergence = gnomon::degrees(1), .sub_rays = 1'000'000}}}) {
        EXPECT_THROW(bad.require_valid(), std::invalid_argument);
    }
}

}  // namespace
