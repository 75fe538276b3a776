// SPDX-License-Identifier: BSL-1.0
#include <utility>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/perception/perception.hpp>
#include <gnomon/perception/perception_result.hpp>

namespace {

TEST(perception_result, begins_empty) {
    const gnomon::perception_result<gnomon::plane_fit> none;
    EXPECT_FALSE(none.floor || none.ceiling);
    EXPECT_TRUE(none.kept.empty() && none.surface.empty() && none.gaps.empty());
    EXPECT_TRUE(none.initial_segments.empty() && none.surfaces.empty());
    EXPECT_EQ(none.index.size(), 0u);
    EXPECT_EQ(none.seconds.normals, 0.0);
}

/// Copies and moved results are values like any other, and can be used for the next call.
TEST(perception_result, is_a_value) {
    std::vector<Eigen::Vector3d> points;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) points.emplace_back(2.0, 0.02 * i, 0.02 * j);
    const gnomon::perception<> chain;
    auto first = chain(points);
    ASSERT_EQ(first.surfaces.size(), 1u);
    auto copy = first;
    const auto moved = std::move(first);
    EXPECT_EQ(copy.surfaces, moved.surfaces);
    chain.into(copy, points);
    EXPECT_EQ(copy.surfaces, moved.surfaces);
    first = std::move(copy);
    chain.into(first, points);
    EXPECT_EQ(first.surfaces, moved.surfaces);
    copy = first;
    chain.into(copy, points, gnomon::team(2));
    EXPECT_EQ(copy.surfaces, moved.surfaces);
}

}  // namespace
