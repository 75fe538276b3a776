// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/core/point_range.hpp>
#include <gnomon/core/scan.hpp>

TEST(scan, is_a_point_range_with_view_points) {
    static_assert(gnomon::point_range<gnomon::scan> && gnomon::has_viewpoints<gnomon::scan>);
    gnomon::scan scan;
    scan.points = {{1, 2, 3}, {4, 5, 6}};
    scan.viewpoints = Eigen::Vector3d(0, 0, 1);
    EXPECT_EQ(gnomon::position_view(scan)[1], Eigen::Vector3d(4, 5, 6));
    EXPECT_EQ(gnomon::detail::viewpoints_of(scan)[1], Eigen::Vector3d(0, 0, 1));
}
