// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/seen_patch.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>

namespace {

using seen::patch, seen::sample_of, seen::seat, seen::sigma;

/// At the far edge something stands up from the surface: its points do not count.
TEST(plane_sample, omits_points_near_the_other_segment) {
    auto points = seat.points(1);
    const auto clean = sample_of(points);
    for (int i = 0; i < 10; ++i) points.push_back({1.7, 0.04 * (i - 4.5), -0.7});
    const auto all = sample_of(points);
    EXPECT_EQ(all.count, clean.count);
    EXPECT_NEAR((all.mean - clean.mean).norm(), 0.0, 1e-12);
    EXPECT_NEAR((all.covariance - clean.covariance).norm(), 0.0, 1e-12);
}

/// A wall tells its direction and a spot does not; a strip tells it one way only.
TEST(plane_knowledge, is_of_direction_and_width) {
    const auto known = [](const patch& seen) {
        return gnomon::detail::knowledge_of(sample_of(seen.points(1)), sigma);
    };
    const auto wall = known({{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}});
    const auto strip = known({{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.02}});
    const auto spot = known({{3, 0, 0}, {0, 0.02, 0}, {0, 0, 0.02}});
    EXPECT_LT(wall.uncertainty.degrees(), 2.0);
    EXPECT_GT(strip.uncertainty.degrees(), 15.0);
    EXPECT_GT(spot.uncertainty.degrees(), 15.0);
    EXPECT_NEAR(std::sqrt(wall.squared_width), 0.5 / std::sqrt(12), 0.01);
    EXPECT_NEAR(std::sqrt(strip.squared_width), 0.5 / std::sqrt(12), 0.01);
    EXPECT_NEAR(std::sqrt(spot.squared_width), 0.02 / std::sqrt(12), 0.001);
}

/// What adjoins a wall at a right angle is not on its plane.
TEST(points_on_plane, omits_points_near_the_other_segment) {
    clouds::cloud points = patch{{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}.points(1);
    for (int i = 0; i < 10; ++i) points.push_back({2.7 + 0.02 * i, 0.25, 0.05 * i});
    points.push_back({clouds::nan, 0.0, 0.0});
    std::vector<gnomon::point_index> all(points.size());
    std::iota(all.begin(), all.end(), gnomon::point_index{0});
    const auto on = gnomon::detail::points_on_plane(points, all, sample_of(points), sigma);
    EXPECT_GE(on.size(), 95u);
    EXPECT_LT(on.back(), 100u);
}

}  // namespace
