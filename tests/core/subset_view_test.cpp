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

TEST(subset_view, keeps_the_view_points_of_its_points) {
    const auto points = clouds::in_cube(10, 1);
    const auto per_point = clouds::in_cube(10, 2);
    const std::vector<gnomon::point_index> chosen{7, 2};
    const auto moving = gnomon::with_viewpoints(points, gnomon::viewpoint_table(per_point));
    const gnomon::subset_view subset(moving, chosen);
    static_assert(gnomon::has_viewpoints<decltype(subset)>);
    EXPECT_EQ(gnomon::detail::viewpoints_of(subset)[0], per_point[7]);
    const auto fixed = gnomon::with_viewpoint(points, {1, 2, 3});
    EXPECT_EQ(gnomon::subset_view(fixed, chosen).viewpoints[1], Eigen::Vector3d(1, 2, 3));
    EXPECT_TRUE(gnomon::subset_view(points, chosen).viewpoints.empty());
}
