// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/perception/detail/neighbors_by_density.hpp>

namespace {

using gnomon::recognition::detail::neighbors_by_density;

constexpr double spacing = 0.01;  // [m]

/// A square grid of n^2 points on a plane.
gnomon::spatial_index grid(int n, double step = spacing) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) points.emplace_back(step * i, step * j, 0.0);
    return gnomon::spatial_index(points);
}

/// The nearest four are one spacing away, and a disc of m spacings has m^2 times as many.
TEST(neighbors_by_density, grow_with_the_square_of_the_reach) {
    for (const double m : {2.0, 3.0, 4.0})
        EXPECT_NEAR(static_cast<double>(neighbors_by_density(grid(60), 100, m * spacing)),
                    4.0 * m * m, 1.0);
}

TEST(neighbors_by_density, are_from_ten_to_k) {
    EXPECT_EQ(neighbors_by_density(grid(60), 100, spacing), 10u);
    EXPECT_EQ(neighbors_by_density(grid(60), 20, 3.0 * spacing), 20u);
    EXPECT_EQ(neighbors_by_density(grid(60), 5, spacing), 5u);
}

/// Without distances between points, there are as many as may be, or as few.
TEST(neighbors_by_density, of_points_at_one_place_and_of_none_are_limited) {
    EXPECT_EQ(neighbors_by_density(grid(10, 0.0), 30, spacing), 30u);
    EXPECT_EQ(neighbors_by_density(grid(2), 30, spacing), 10u);
    EXPECT_EQ(neighbors_by_density(grid(0), 30, spacing), 10u);
}

}  // namespace
