// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/radius.hpp>

namespace {

TEST(radius, includes_the_distance_itself) {
    const clouds::cloud line{{0, 0, 0}, {0.5, 0, 0}, {1.0, 0, 0}, {1.5, 0, 0}};
    const auto graph = gnomon::radius{.r = 0.5}(line);
    EXPECT_EQ(std::vector(graph[1].begin(), graph[1].end()),
              (std::vector<gnomon::point_index>{0, 2}));
    EXPECT_EQ(graph[3].size(), 1u);
}

TEST(radius, is_symmetric) {
    const auto points = clouds::sheet(800, 5);
    const auto graph = gnomon::radius{.r = 0.1}(points);
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (const auto j : graph[i]) {
            ASSERT_NE(std::find(graph[j].begin(), graph[j].end(), i), graph[j].end());
        }
    }
}

TEST(radius, rejects_invalid_radii) {
    for (const double r : {-1.0, clouds::nan, clouds::infinity}) {
        EXPECT_THROW((void)gnomon::radius{.r = r}(clouds::in_cube(5, 1)), std::invalid_argument);
    }
}

}  // namespace
