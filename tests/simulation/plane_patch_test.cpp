// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/plane_patch.hpp>

namespace {

static_assert(gnomon::shape<gnomon::plane_patch>);
const gnomon::plane_patch sheet{0.4, 0.3};

TEST(plane_patch, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(sheet, 1), 100u); }

TEST(plane_patch, ends_where_it_ends) {
    EXPECT_TRUE(sheet.first_hit({{0.2, 0.15, 1}, {0, 0, -1}}));
    EXPECT_FALSE(sheet.first_hit({{0.2001, 0.0, 1}, {0, 0, -1}}));
    EXPECT_FALSE(sheet.first_hit({{0.0, 0.1501, 1}, {0, 0, -1}}));
}

TEST(plane_patch, is_seen_from_both_sides_and_not_from_the_edge) {
    EXPECT_EQ(sheet.first_hit({{0, 0, 1}, {0, 0, -1}})->normal, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(sheet.first_hit({{0, 0, -1}, {0, 0, 1}})->normal, Eigen::Vector3d(0, 0, -1));
    EXPECT_FALSE(sheet.first_hit({{-3, 0, 0}, {1, 0, 0}}));
    EXPECT_FALSE(sheet.first_hit({{0, 0, 1}, {0, 0, 1}}));
}

}  // namespace
