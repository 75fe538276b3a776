// SPDX-License-Identifier: BSL-1.0
#include <limits>
#include <stdexcept>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/oriented_box.hpp>

namespace {

TEST(oriented_box, contains_its_surface_in_any_orientation) {
    const Eigen::Matrix3d axes = clouds::random_rotation(5);
    const gnomon::oriented_box box{.center = {4e5, 5e6, 100}, .axes = axes, .lengths = {4, 2, 1}};
    for (int a = 0; a < 3; ++a) {
        for (const double side : {-0.5, 0.5}) {
            const Eigen::Vector3d reach = side * box.lengths[a] * axes.col(a);
            EXPECT_TRUE(box.contains(box.center + 0.999999 * reach));
            EXPECT_FALSE(box.contains(box.center + 1.000001 * reach));
        }
    }
    EXPECT_TRUE(gnomon::oriented_box{}.contains({0, 0, 0}));
    EXPECT_FALSE(gnomon::oriented_box{}.contains({0, 0, 1e-300}));
    EXPECT_FALSE(box.contains({clouds::nan, 5e6, 100}));
}

TEST(oriented_box, has_a_volume_and_begins_empty) {
    EXPECT_EQ(gnomon::oriented_box{}.volume(), 0.0);
    EXPECT_EQ(gnomon::oriented_box{}.axes, Eigen::Matrix3d::Identity());
    EXPECT_EQ((gnomon::oriented_box{.lengths = {2.0, 3.0, 4.0}}.volume()), 24.0);
}

TEST(oriented_box, may_be_without_end) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const gnomon::oriented_box slab{.lengths = {infinity, infinity, 2}};
    gnomon::detail::require_valid(slab);
    EXPECT_TRUE(slab.contains({1e9, -1e9, 1}));
    EXPECT_FALSE(slab.contains({0, 0, 1.001}));
}

TEST(oriented_box, is_refused_unless_it_is_a_box) {
    const auto refuse = [](gnomon::oriented_box box) {
        EXPECT_THROW(gnomon::detail::require_valid(box), std::invalid_argument);
    };
    refuse({.center = {clouds::nan, 0, 0}});
    refuse({.lengths = {1, -1, 1}});
    refuse({.lengths = {1, clouds::nan, 1}});
    refuse({.axes = 2.0 * Eigen::Matrix3d::Identity()});
    refuse({.axes = Eigen::Matrix3d::Ones()});
}

}  // namespace
