// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/viewpoints.hpp>

namespace {

const Eigen::Vector3d a(1, 0, 0);
const Eigen::Vector3d b(0, 2, 0);

TEST(viewpoint_table, holds_view_points_of_the_cloud_the_scan_or_the_point) {
    EXPECT_EQ(gnomon::viewpoint_table()[3], Eigen::Vector3d(0, 0, 0));
    EXPECT_TRUE(gnomon::viewpoint_table().empty());
    EXPECT_EQ(gnomon::viewpoint_table(a)[3], a);
    const gnomon::viewpoint_table per_scan({a, b}, {0, 1, 1, 0});
    EXPECT_EQ(per_scan[2], b);
    EXPECT_EQ(per_scan[3], a);
    EXPECT_TRUE(per_scan.covers(4));
    EXPECT_FALSE(per_scan.covers(5));
    const gnomon::viewpoint_table per_point(std::vector<Eigen::Vector3d>{a, b});
    EXPECT_EQ(per_point[1], b);
    EXPECT_TRUE(per_point.covers(2));
    EXPECT_FALSE(per_point.covers(1));
}

TEST(viewpoint_table, refuses_points_of_missing_scans_and_wrong_sizes) {
    EXPECT_THROW(gnomon::viewpoint_table({a}, {0, 1}), std::invalid_argument);
    EXPECT_FALSE(gnomon::viewpoint_table({a, b}, {}).covers(7));
    const auto points = clouds::in_cube(3, 1);
    EXPECT_THROW((void)gnomon::with_viewpoints(points, gnomon::viewpoint_table(std::vector{a, b})),
                 std::invalid_argument);
}

TEST(viewpoint_table, travels_with_a_bare_range) {
    const auto points = clouds::in_cube(3, 1);
    const auto seen = gnomon::with_viewpoint(points, b);
    static_assert(gnomon::point_range<decltype(seen)> && gnomon::has_viewpoints<decltype(seen)>);
    static_assert(!gnomon::has_viewpoints<clouds::cloud>);
    EXPECT_EQ(gnomon::position_view(seen)[2], points[2]);
    EXPECT_EQ(gnomon::detail::viewpoints_of(seen)[2], b);
    EXPECT_EQ(gnomon::detail::viewpoints_of(points)[2], Eigen::Vector3d(0, 0, 0));
}

/// A table that was moved from knows no view point.
TEST(viewpoint_table, is_empty_when_moved_from) {
    gnomon::viewpoint_table all(Eigen::Vector3d(1, 2, 3));
    const gnomon::viewpoint_table moved = std::move(all);
    EXPECT_TRUE(all.empty() && all.covers(5));
    EXPECT_EQ(all[4], Eigen::Vector3d(0, 0, 0));
    EXPECT_EQ(moved[4], Eigen::Vector3d(1, 2, 3));
    all = moved;
    EXPECT_EQ(all[4], Eigen::Vector3d(1, 2, 3));
}

/// A table, and one that was moved into itself, is of its number.
TEST(viewpoint_table, has_the_number_of_its_copies) {
    const gnomon::viewpoint_table one(Eigen::Vector3d(1.0, 2.0, 3.0)),
        other(Eigen::Vector3d(1.0, 2.0, 3.0));
    EXPECT_NE(one.number(), other.number());
    gnomon::viewpoint_table copy = one;
    EXPECT_EQ(copy.number(), one.number());
    gnomon::viewpoint_table& same = copy;
    copy = std::move(same);
    EXPECT_EQ(copy[0], copy.empty() ? Eigen::Vector3d(0.0, 0.0, 0.0) : one[0]);
    const gnomon::viewpoint_table moved = std::move(copy);
    EXPECT_EQ(copy.number(), gnomon::viewpoint_table().number());  // NOLINT: it is empty
    EXPECT_EQ(moved[0].size(), 3);
}

TEST(viewpoint_table, keeps_scans_in_subsets_that_have_more_points) {
    const gnomon::viewpoint_table table({{1, 0, 0}, {2, 0, 0}}, {0, 1, 1, 0});
    const std::vector<gnomon::point_index> most{3, 1, 2}, one{2};
    EXPECT_EQ(table.subset(most).positions().size(), 2u);
    EXPECT_EQ(table.subset(one).positions().size(), 1u);
    for (const auto& kept : {most, one}) {
        const gnomon::viewpoint_table part = table.subset(kept);
        EXPECT_TRUE(part.covers(kept.size()));
        for (std::size_t k = 0; k < kept.size(); ++k) EXPECT_EQ(part[k], table[kept[k]]);
    }
}

}  // namespace
