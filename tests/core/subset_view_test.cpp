// SPDX-License-Identifier: BSL-1.0
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/subset_view.hpp>

TEST(subset_view, is_a_point_range_of_the_selected_points) {
    const auto points = clouds::in_cube(10, 1);
    const std::vector<gnomon::point_index> chosen{7, 2, 2, 9};
    const gnomon::subset_view subset(points, chosen);
    static_assert(gnomon::point_range<decltype(subset)>);
    ASSERT_EQ(subset.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(subset[i], points[chosen[i]]);
}
