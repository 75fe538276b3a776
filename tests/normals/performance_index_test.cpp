// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/normals/performance_index.hpp>

namespace {

using gnomon::performance_index;

TEST(performance_index, is_half_quality_and_half_speed) {  // Eq. (3.13)
    EXPECT_EQ(performance_index(1.0, 1.0, 1.0), 1.0);
    EXPECT_EQ(performance_index(1.0, 0.5, 1.0), 1.5);  // faster than wanted: over one
    EXPECT_EQ(performance_index(0.0, 4.0, 1.0), 0.125);
    // Tab. 3.3 of the thesis: AreaWeighted comes first.
    EXPECT_NEAR(performance_index(0.9413, 10.30, 1.0), 0.5192, 1e-4);
    EXPECT_NEAR(performance_index(0.9436, 8.00, 1.0), 0.5343, 1e-4);
    EXPECT_NEAR(performance_index(0.9328, 8.44, 1.0), 0.5256, 1e-4);
    EXPECT_NEAR(performance_index(0.9180, 4.44, 1.0), 0.5716, 1e-4);
    EXPECT_NEAR(performance_index(0.8840, 8.61, 1.0), 0.5001, 1e-4);
}

TEST(performance_index, rejects_invalid_times_and_qualities) {
    for (const double bad : {0.0, -1.0, clouds::nan, clouds::infinity}) {
        EXPECT_THROW((void)performance_index(0.5, bad, 1.0), std::invalid_argument);
        EXPECT_THROW((void)performance_index(0.5, 1.0, bad), std::invalid_argument);
    }
    for (const double bad : {-0.1, 1.1, clouds::nan})
        EXPECT_THROW((void)performance_index(bad, 1.0, 1.0), std::invalid_argument);
}

}  // namespace
