// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include <gnomon/simulation/bounds.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(bounds, begin_empty_and_grow) {
    sim::bounds b;
    EXPECT_GT(b.low.x(), b.high.x());
    b.extend(sim::bounds{});
    EXPECT_GT(b.low.x(), b.high.x());
    b.extend(Eigen::Vector3d(1, 2, 3));
    EXPECT_EQ(b.low, b.high);
    b.extend(sim::bounds{{-1, 2, 4}, {0, 3, 5}});
    EXPECT_EQ(b.low, Eigen::Vector3d(-1, 2, 3));
    EXPECT_EQ(b.high, Eigen::Vector3d(1, 3, 5));
    EXPECT_EQ(b.middle(), Eigen::Vector3d(0, 2.5, 4));
    EXPECT_EQ(b.size(), Eigen::Vector3d(2, 1, 2));
}

}  // namespace
