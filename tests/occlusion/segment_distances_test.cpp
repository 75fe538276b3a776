// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/occlusion/detail/segment_distances.hpp>

namespace {

using gnomon::detail::angular_distance, gnomon::detail::orthogonal_distance;

/// A rectangle of 5 x 4 points, 10 cm apart, turned about the y-axis.
clouds::cloud rectangle(const Eigen::Vector3d& center, double turned) {
    clouds::cloud points;
    for (int i = -2; i <= 2; ++i) {
        for (int j = 0; j < 4; ++j) {
            const double along = 0.1 * i;
            points.push_back(center + Eigen::Vector3d(along * std::cos(turned), 0.1 * (j - 1.5),
                                                      along * std::sin(turned)));
        }
    }
    return points;
}

TEST(segment_distances, are_those_of_rectangles_in_one_plane) {
    const auto a = gnomon::principal_frame_of(rectangle({0, 0, 1}, 0.0));
    const auto b = gnomon::principal_frame_of(rectangle({3, 4, 1}, 0.0));
    EXPECT_NEAR(angular_distance(a, b), 0.0, 1e-12);
    EXPECT_NEAR(orthogonal_distance(a, b), 0.0, 1e-12);
    EXPECT_EQ(orthogonal_distance(a, a), 0.0);
}

TEST(segment_distances, are_those_of_parallel_rectangles) {
    const auto a = gnomon::principal_frame_of(rectangle({0, 0, 1}, 0.0));
    const auto b = gnomon::principal_frame_of(rectangle({3, 0, 1.04}, 0.0));
    EXPECT_NEAR(orthogonal_distance(a, b), 0.04, 1e-12);
    EXPECT_NEAR(angular_distance(a, b), 0.0, 1e-12);
}

/// The second centroid lies in the plane of the first, which is 3 sin(t) from that of the second.
TEST(segment_distances, take_the_smaller_distance_of_a_plane) {
    for (const double t : {1e-7, 0.1, 0.7, 0.5 * std::numbers::pi}) {
        const auto a = gnomon::principal_frame_of(rectangle({0, 0, 0}, 0.0));
        const auto b = gnomon::principal_frame_of(rectangle({3, 0, 0}, t));
        EXPECT_NEAR(angular_distance(a, b), t, 1e-12);
        EXPECT_NEAR(orthogonal_distance(a, b), 0.0, 1e-12);
        const auto c = gnomon::principal_frame_of(rectangle({3, 0, 0.5}, t));
        const double from_other = std::abs(3.0 * std::sin(t) - 0.5 * std::cos(t));
        EXPECT_NEAR(orthogonal_distance(a, c), std::min(0.5, from_other), 1e-12);
    }
}

/// An obtuse angle between normals is an acute one between planes.
TEST(segment_distances, know_no_sides_of_planes) {
    auto a = gnomon::principal_frame_of(rectangle({0, 0, 0}, 0.0));
    const auto b = gnomon::principal_frame_of(rectangle({1, 0, 0.2}, 0.3));
    const double angle = angular_distance(a, b), offset = orthogonal_distance(a, b);
    a.axes.col(2) *= -1.0;
    EXPECT_DOUBLE_EQ(angular_distance(a, b), angle);
    EXPECT_DOUBLE_EQ(orthogonal_distance(a, b), offset);
}

TEST(segment_distances, are_symmetric_and_stay_under_rigid_motion) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto first = clouds::sheet(60, seed);
        const auto second = clouds::sheet(40, seed + 100);
        const auto a = gnomon::principal_frame_of(first);
        const auto b = gnomon::principal_frame_of(second);
        EXPECT_DOUBLE_EQ(angular_distance(a, b), angular_distance(b, a));
        EXPECT_DOUBLE_EQ(orthogonal_distance(a, b), orthogonal_distance(b, a));
        const auto r = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& t : {Eigen::Vector3d(1, 2, 3), {6e5, 4.8e6, 100}}) {
            const auto c = gnomon::principal_frame_of(clouds::moved(first, r, t));
            const auto d = gnomon::principal_frame_of(clouds::moved(second, r, t));
            EXPECT_NEAR(angular_distance(c, d), angular_distance(a, b), 1e-7);
            EXPECT_NEAR(orthogonal_distance(c, d), orthogonal_distance(a, b), 1e-7);
        }
    }
}

}  // namespace
