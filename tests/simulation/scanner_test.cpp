// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/simulation/scanner.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;

/// n = t_s f_s alpha_FoV / alpha_r, Fig. 2.16.
TEST(scanner, counts_as_the_thesis_does) {
    for (const auto& [finder, count] : {std::pair{sim::densities::low(), 7'200u},
                                        {sim::densities::medium(), 28'800u},
                                        {sim::densities::high(), 115'200u}}) {
        EXPECT_EQ(finder.lines(4.0) * finder.beams(), count);
    }
    // Tab. 4.1, where times are rounded to a tenth of a second.
    EXPECT_EQ(sim::scanner().lines(6.9) * sim::scanner().beams(), 198'720u);
    EXPECT_EQ(sim::scanner().lines(5.5) * sim::scanner().beams(), 158'400u);
}

TEST(scanner, cuts_its_field_of_view_into_equal_parts) {
    const sim::scanner finder{.field_of_view = degrees(90), .resolution = degrees(1)};
    ASSERT_EQ(finder.beams(), 90u);
    const auto first = finder.direction(0);
    const auto last = finder.direction(89);
    EXPECT_LT((first - Eigen::Vector3d(last.x(), -last.y(), 0)).norm(), 1e-15);
    EXPECT_LT(first.y(), 0.0);
    for (std::size_t j = 0; j < 90; ++j) {
        EXPECT_NEAR(finder.direction(j).norm(), 1.0, 1e-15);
        if (j > 0) {
            const double cosine = finder.direction(j).dot(finder.direction(j - 1));
            EXPECT_NEAR(cosine, std::cos(degrees(1).radians()), 1e-15);
        }
    }
}

/// Also where the resolution is no part of the field of view, as that of the URG-04LX.
TEST(scanner, has_a_symmetric_field_of_view) {
    for (const auto& finder :
         {sim::scanner(), sim::scanner{.field_of_view = degrees(10), .resolution = degrees(9)},
          sim::scanner{.field_of_view = degrees(10), .resolution = degrees(4)},
          sim::densities::low(), sim::densities::medium(), sim::scanners::sick_lms_200(),
          sim::scanners::sick_lms_400(), sim::scanners::hokuyo_urg_04lx(),
          sim::scanners::hokuyo_utm_30lx()}) {
        const std::size_t n = finder.beams();
        for (std::size_t j = 0; j < n; ++j) {
            const auto left = finder.direction(n - 1 - j);
            EXPECT_EQ(finder.direction(j), Eigen::Vector3d(left.x(), -left.y(), 0.0));
        }
    }
}

TEST(scanner, presets_are_valid) {
    for (const auto& finder :
         {sim::scanner(), sim::scanners::sick_lms_200(), sim::scanners::sick_lms_400(),
          sim::scanners::hokuyo_urg_04lx(), sim::scanners::hokuyo_utm_30lx()}) {
        EXPECT_NO_THROW(finder.require_valid());
    }
    EXPECT_EQ(sim::scanners::sick_lms_200().beams(), 360u);
    EXPECT_EQ(sim::scanners::sick_lms_400().beams(), 280u);
    EXPECT_EQ(sim::scanners::hokuyo_urg_04lx().beams(), 682u);
    EXPECT_EQ(sim::scanners::hokuyo_utm_30lx().beams(), 1080u);
}

TEST(scanner, rejects_invalid_parameters) {
    for (const sim::scanner& bad :
         {sim::scanner{.field_of_view = degrees(361)}, sim::scanner{.resolution = degrees(0)},
          sim::scanner{.resolution = degrees(200)},
          sim::scanner{.field_of_view = degrees(clouds::nan)},
          sim::scanner{.resolution = degrees(clouds::nan)},
          sim::scanner{.resolution = degrees(1e-300)}, sim::scanner{.resolution = degrees(1e-18)},
          sim::scanner{.frequency = 0}, sim::scanner{.frequency = clouds::infinity},
          sim::scanner{.min_range = -1}, sim::scanner{.min_range = 40},
          sim::scanner{.max_range = clouds::infinity}}) {
        EXPECT_THROW(bad.require_valid(), std::invalid_argument);
    }
}

}  // namespace
