// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/occlusion/boundary_pairs.hpp>

namespace {

using gnomon::detail::boundary_pair, gnomon::point_index;
using index_list = std::vector<point_index>;

Eigen::Vector3d mean(const clouds::cloud& points, const index_list& some) {
    Eigen::Vector3d sum(0, 0, 0);
    for (const point_index i : some) sum += points[i];
    return sum / static_cast<double>(some.size());
}

/// All of some points by distance from a place, equal ones by index.
index_list sorted_from(const clouds::cloud& points, index_list some, const Eigen::Vector3d& place) {
    std::sort(some.begin(), some.end(), [&](point_index a, point_index b) {
        return std::pair(gnomon::squared_distance(points[a], place), a) <
               std::pair(gnomon::squared_distance(points[b], place), b);
    });
    return some;
}

std::vector<boundary_pair> boundary_pairs(
    const clouds::cloud& points, std::span<const point_index> first,
    std::span<const point_index> second,
    const std::pair<Eigen::Vector3d, Eigen::Vector3d>& centroids, std::size_t pairs = 6) {
    std::vector<boundary_pair> found;
    gnomon::detail::append_boundary_pairs(found, points, first, second, centroids, pairs);
    return found;
}

std::vector<boundary_pair> pairs_of(const clouds::cloud& points, const index_list& first,
                                    const index_list& second, std::size_t pairs) {
    return boundary_pairs(points, std::span(first), std::span(second),
                          {mean(points, first), mean(points, second)}, pairs);
}

void expect_brute_force(const clouds::cloud& points, const index_list& first,
                        const index_list& second, std::size_t pairs) {
    const auto near_second = sorted_from(points, first, mean(points, second));
    const auto near_first = sorted_from(points, second, mean(points, first));
    std::vector<std::pair<point_index, point_index>> expected;
    for (std::size_t i = 0; i < std::min(pairs / 2, first.size()); ++i)
        expected.push_back(
            {near_second[i], sorted_from(points, second, points[near_second[i]])[0]});
    for (std::size_t i = 0; i < std::min(pairs / 2, second.size()); ++i)
        expected.push_back({sorted_from(points, first, points[near_first[i]])[0], near_first[i]});
    const auto found = pairs_of(points, first, second, pairs);
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(std::pair(found[i].first, found[i].second), expected[i]);
        EXPECT_DOUBLE_EQ(found[i].distance,
                         (points[found[i].first] - points[found[i].second]).norm());
    }
}

TEST(boundary_pairs, equal_the_brute_force) {
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        for (const auto& points : {clouds::in_cube(200, seed), clouds::on_grid(200, seed)}) {
            index_list first, second;
            gnomon::random_stream random(seed, 3);
            for (point_index i = 0; i < points.size(); ++i) {
                const double u = random.uniform();
                if (u < 0.3) first.push_back(i);
                if (u > 0.6) second.push_back(i);
            }
            for (const std::size_t n : {2u, 6u, 20u, 1000u})
                expect_brute_force(points, first, second, n);
        }
    }
}

/// Fig. 4.7: two rectangles of points 3 cm apart, with a gap of 30 cm between x = 0 and x = 0.3.
TEST(boundary_pairs, lie_where_rectangles_face_each_other) {
    clouds::cloud points;
    index_list first, second;
    for (int i = 0; i < 30; ++i) {
        for (int j = -20; j <= 20; ++j) {
            first.push_back(static_cast<point_index>(points.size()));
            points.push_back({-0.03 * i, 0.03 * j, 0});
            second.push_back(static_cast<point_index>(points.size()));
            points.push_back({0.3 + 0.03 * i, 0.03 * j + 0.01, 0});
        }
    }
    const auto found = pairs_of(points, first, second, 6);
    ASSERT_EQ(found.size(), 6u);
    for (const boundary_pair& p : found) {
        EXPECT_GE(points[p.first].x(), -0.06);
        EXPECT_LE(points[p.second].x(), 0.36);
    }
    EXPECT_NEAR(gnomon::detail::coplanar_distance(found), std::hypot(0.3, 0.01), 1e-12);
}

TEST(boundary_pairs, of_equally_near_points_take_the_first) {
    const clouds::cloud points{{0, 1, 0}, {0, -1, 0}, {5, 1, 0}, {5, -1, 0}, {5, -1, 0}};
    const auto found = pairs_of(points, {0, 1}, {2, 3}, 2);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].first, 0u);
    EXPECT_EQ(found[0].second, 2u);
    EXPECT_EQ(found[1].second, 2u);
    const auto twins = pairs_of(points, {1}, {3, 4}, 2);
    EXPECT_EQ(twins[0].second, 3u);
    EXPECT_EQ(twins[1].second, 3u);
}

TEST(boundary_pairs, of_small_segments_are_fewer) {
    const clouds::cloud points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
    EXPECT_EQ(pairs_of(points, {0}, {1}, 6).size(), 2u);
    EXPECT_EQ(pairs_of(points, {0, 1}, {2}, 6).size(), 3u);
    EXPECT_EQ(pairs_of(points, {0, 1}, {2}, 2).size(), 2u);
    EXPECT_TRUE(pairs_of(points, {0, 1}, {2}, 0).empty());
    EXPECT_TRUE(pairs_of(points, {0}, {}, 6).empty());
    EXPECT_TRUE(pairs_of(points, {}, {0}, 6).empty());
}

/// Segments may be of your own making.
TEST(boundary_pairs, pass_over_points_that_are_not_finite) {
    const clouds::cloud points{{clouds::nan, 0, 0},      {0, 0, 0}, {1, 0, 0},
                               {2, clouds::infinity, 0}, {3, 0, 0}, {4, 0, 0}};
    const index_list first{0, 1, 2}, second{3, 4, 5};
    const auto found = boundary_pairs(points, std::span(first), std::span(second),
                                      {Eigen::Vector3d(0.5, 0, 0), Eigen::Vector3d(3.5, 0, 0)}, 6);
    ASSERT_EQ(found.size(), 4u);
    for (const boundary_pair& p : found) {
        EXPECT_TRUE(p.first == 1u || p.first == 2u);
        EXPECT_TRUE(p.second == 4u || p.second == 5u);
    }
    EXPECT_EQ(gnomon::detail::coplanar_distance(found), 2.0);
    const index_list none{0}, some{4};
    const std::pair<Eigen::Vector3d, Eigen::Vector3d> centroids{{0, 0, 0}, {3, 0, 0}};
    EXPECT_TRUE(boundary_pairs(points, std::span(none), std::span(some), centroids).empty());
    EXPECT_TRUE(boundary_pairs(points, std::span(some), std::span(none), centroids).empty());
    const index_list no_point{static_cast<gnomon::point_index>(points.size())};
    EXPECT_THROW((void)boundary_pairs(points, std::span(some), std::span(no_point), centroids),
                 std::invalid_argument);
    EXPECT_THROW((void)boundary_pairs(points, std::span(no_point), std::span(some), centroids),
                 std::invalid_argument);
}

TEST(coplanar_distance, is_the_least_and_infinite_without_pairs) {
    const std::vector<boundary_pair> pairs{{0, 1, 3.0}, {0, 2, 0.5}, {1, 2, 2.0}};
    EXPECT_EQ(gnomon::detail::coplanar_distance(pairs), 0.5);
    EXPECT_EQ(gnomon::detail::coplanar_distance({}), std::numeric_limits<double>::infinity());
}

}  // namespace
