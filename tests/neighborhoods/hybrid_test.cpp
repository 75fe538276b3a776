// SPDX-License-Identifier: BSL-1.0
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

/// Oracle: the neighborhoods of knn, cut at the radius.
TEST(hybrid, is_knn_within_a_radius) {
    for (const auto& points : {clouds::in_cube(800, 1), clouds::on_grid(800, 2, 0.125)}) {
        const auto nearest = gnomon::knn{.k = 12}(points);
        for (const double r : {0.0, 0.1, 0.125, 0.25, 3.0}) {
            const auto graph = gnomon::hybrid{.k = 12, .r = r}(points);
            for (std::size_t i = 0; i < points.size(); ++i) {
                std::vector<gnomon::point_index> expected;
                for (const auto j : nearest[i]) {
                    if (gnomon::squared_distance(points[i], points[j]) <= r * r)
                        expected.push_back(j);
                }
                ASSERT_EQ(std::vector(graph[i].begin(), graph[i].end()), expected);
            }
        }
    }
}

TEST(hybrid, rejects_invalid_numbers_of_neighbors_and_radii) {
    const auto points = clouds::in_cube(10, 1);
    EXPECT_THROW((void)(gnomon::hybrid{.k = 0}(points)), std::invalid_argument);
    for (const double r : {-1.0, clouds::nan, std::numeric_limits<double>::infinity()})
        EXPECT_THROW((void)(gnomon::hybrid{.k = 3, .r = r}(points)), std::invalid_argument);
}

}  // namespace
