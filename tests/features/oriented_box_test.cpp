// SPDX-License-Identifier: BSL-1.0
#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/features/oriented_box.hpp>
#include <gnomon/features/principal_frame.hpp>

namespace {

TEST(oriented_box, has_a_volume_and_begins_empty) {
    EXPECT_EQ(gnomon::oriented_box{}.volume(), 0.0);
    EXPECT_EQ(gnomon::oriented_box{}.axes, Eigen::Matrix3d::Identity());
    const gnomon::oriented_box box{.lengths = {2.0, 3.0, 4.0}};
    EXPECT_EQ(box.volume(), 24.0);
}

TEST(oriented_box, is_part_of_a_principal_frame) {
    gnomon::principal_frame frame;
    frame.box_center = {1, 2, 3};
    frame.box_size = {4, 5, 6};
    frame.axes << 0, 0, 1, 1, 0, 0, 0, 1, 0;
    const gnomon::oriented_box box = frame.box();
    EXPECT_EQ(box.center, frame.box_center);
    EXPECT_EQ(box.lengths, frame.box_size);
    EXPECT_EQ(box.axes, frame.axes);
}

}  // namespace
