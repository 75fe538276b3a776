// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>

namespace {

using gnomon::detail::plane_comparison, gnomon::detail::plane_sample;

constexpr double sigma = 0.015;

/// A rectangle that rays from the origin meet, with noise along them.
struct seen_rectangle {
    Eigen::Vector3d center, side, other_side;
    int rays = 10;  ///< in each direction

    [[nodiscard]] clouds::cloud points(std::uint64_t seed) const {
        gnomon::random_stream random(seed);
        clouds::cloud result;
        for (int i = 0; i < rays; ++i) {
            for (int j = 0; j < rays; ++j) {
                const double a = (i + 0.5) / rays - 0.5, b = (j + 0.5) / rays - 0.5;
                const Eigen::Vector3d p = center + a * side + b * other_side;
                result.push_back(p * (1.0 + sigma * random.gaussian() / p.norm()));
            }
        }
        return result;
    }
};

plane_sample sample_of(const clouds::cloud& points) {
    std::vector<gnomon::point_index> all(points.size());
    std::iota(all.begin(), all.end(), gnomon::point_index{0});
    return gnomon::detail::plane_sample_of(points, all, {}, sigma);
}

bool are_of_one(const plane_sample& wide, const plane_sample& slim) {
    return plane_comparison(wide, slim, sigma).is_of_one(gnomon::degrees(15), 0.05);
}

/// How many of 100 scans of two rectangles show them in one plane.
int found_in_one_plane(const seen_rectangle& wide, const seen_rectangle& slim) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const auto a = sample_of(wide.points(2 * seed)), b = sample_of(slim.points(2 * seed + 1));
        found += are_of_one(a, b) ? 1 : 0;
    }
    return found;
}

/// A seat 1.5 m away and 80 cm below the eye, and what may be part of it or not.
const seen_rectangle seat{{1.5, 0.0, -0.8}, {0.4, 0, 0}, {0, 0.4, 0}};

TEST(plane_comparison, knows_another_part_of_a_surface) {
    EXPECT_GE(found_in_one_plane(seat, {{1.5, 0.6, -0.8}, {0.4, 0, 0}, {0, 0.3, 0}}), 97);
    // No wider than noise.
    EXPECT_GE(found_in_one_plane(seat, {{1.5, 0.4, -0.8}, {0.4, 0, 0}, {0, 0.02, 0}}), 97);
}

TEST(plane_comparison, tells_an_offset_from_noise) {
    EXPECT_EQ(found_in_one_plane(seat, {{1.5, 0.6, -0.83}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
    EXPECT_EQ(found_in_one_plane(seat, {{1.5, 0.6, -0.77}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
}

/// The front of a seat, no higher than noise: the direction of its least spread is that of nothing.
TEST(plane_comparison, tells_an_edge_from_the_surface_it_bounds) {
    const seen_rectangle front{{1.3, 0.0, -0.82}, {0, 0.4, 0}, {0, 0, 0.04}};
    EXPECT_LE(found_in_one_plane(seat, front), 3);
}

TEST(plane_comparison, takes_an_angle_up_to_the_largest) {
    const auto wall = [](double degrees) {
        const gnomon::angle turned = gnomon::degrees(degrees);
        return seen_rectangle{
            {3.0, 0.5, 0.0}, {-0.4 * sin(turned), 0.4 * cos(turned), 0}, {0, 0, 0.4}, 30};
    };
    const seen_rectangle wide{{3.0, -0.5, 0.0}, {0, 1.0, 0}, {0, 0, 1.0}, 50};
    EXPECT_GE(found_in_one_plane(wide, wall(0.0)), 97);
    EXPECT_GE(found_in_one_plane(wide, wall(10.0)), 97);
    EXPECT_EQ(found_in_one_plane(wide, wall(20.0)), 0);
}

/// What noise cannot have made of one plane is of two; of what is uncertain neither is said.
TEST(plane_comparison, knows_what_is_certainly_of_two) {
    const auto are_of_two = [](const seen_rectangle& wide, const seen_rectangle& slim) {
        int found = 0;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const auto a = sample_of(wide.points(2 * seed)),
                       b = sample_of(slim.points(2 * seed + 1));
            const plane_comparison both(a, b, sigma);
            const bool of_two = both.is_of_two(gnomon::degrees(15), 0.05);
            EXPECT_FALSE(of_two && both.is_of_one(gnomon::degrees(15), 0.05));
            found += of_two ? 1 : 0;
        }
        return found;
    };
    EXPECT_EQ(are_of_two(seat, {{1.5, 0.6, -0.8}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
    EXPECT_EQ(are_of_two(seat, {{1.5, 0.6, -0.77}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
    EXPECT_GE(are_of_two(seat, {{1.5, 0.6, -0.68}, {0.4, 0, 0}, {0, 0.3, 0}}), 97);
    EXPECT_GE(are_of_two(seat, {{1.7, 0.0, -0.6}, {0, 0.4, 0}, {0, 0, 0.4}}), 97);
    EXPECT_EQ(are_of_two(seat, {{1.8, 0.0, -0.8}, {0.02, 0, 0}, {0, 0.02, 0}, 3}), 0);
}

/// Where noise would hide an offset, nothing is told.
TEST(plane_comparison, does_not_reach_farther_than_it_knows) {
    const seen_rectangle tile{{3.0, 0.0, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6};
    EXPECT_GE(found_in_one_plane(tile, {{3.0, 0.12, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6}), 97);
    EXPECT_EQ(found_in_one_plane(tile, {{3.0, 1.0, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6}), 0);
}

/// What is hardly wider than noise may be off by that, but never by more than the largest offset.
TEST(plane_comparison, allows_no_speck_more_than_the_largest_offset) {
    int near = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const seen_rectangle wall{{3, 0, 0}, {0, 1, 0}, {0, 0, 1}, 40};
        const seen_rectangle small{{3.015, 0, 0.52}, {0, 0.04, 0}, {0, 0, 0.04}, 14};
        const auto wide = sample_of(wall.points(seed)), speck = sample_of(small.points(seed + 100));
        const plane_comparison both(wide, speck, sigma);
        near += both.is_of_one(gnomon::degrees(15), 0.05) ? 1 : 0;
        EXPECT_FALSE(both.is_of_one(gnomon::degrees(15), 0.008)) << seed;
    }
    EXPECT_GE(near, 90);
}

TEST(plane_comparison, of_no_points_is_nothing) {
    const plane_sample none = sample_of({}), some = sample_of(seat.points(1));
    EXPECT_EQ(none.count, 0u);
    EXPECT_FALSE(are_of_one(some, none));
    EXPECT_FALSE(are_of_one(none, some));
    EXPECT_FALSE(plane_comparison(some, none, sigma).is_of_two(gnomon::degrees(15), 0.05));
    EXPECT_EQ(sample_of({{clouds::nan, 0, 0}}).count, 0u);
}

/// At the far edge something stands up from the surface: its points do not count.
TEST(plane_sample, leaves_out_what_adjoins) {
    auto points = seat.points(1);
    const auto clean = sample_of(points);
    for (int i = 0; i < 10; ++i) points.push_back({1.7, 0.04 * (i - 4.5), -0.7});
    const auto all = sample_of(points);
    EXPECT_EQ(all.count, clean.count);
    EXPECT_NEAR((all.mean - clean.mean).norm(), 0.0, 1e-12);
    EXPECT_NEAR((all.covariance - clean.covariance).norm(), 0.0, 1e-12);
}

/// Noise lies along the rays: at a grazing angle it moves nothing off its plane, be it ever so
/// slim.
TEST(plane_comparison, tolerates_less_at_a_slant) {
    const seen_rectangle board{{4.0, 0.0, -0.4}, {1.0, 0, 0}, {0, 0.4, 0}};
    const seen_rectangle beside{{4.0, 0.3, -0.4}, {0.3, 0, 0}, {0, 0.1, 0}};
    const seen_rectangle above{{4.0, 0.3, -0.385}, {0.3, 0, 0}, {0, 0.1, 0}};
    EXPECT_GE(found_in_one_plane(board, beside), 90);
    EXPECT_LE(found_in_one_plane(board, above), 5);
}

/// A wall tells its direction and a spot does not; a strip tells it one way only.
TEST(plane_knowledge, is_of_direction_and_width) {
    const auto known = [](const seen_rectangle& seen) {
        return gnomon::detail::knowledge_of(sample_of(seen.points(1)), sigma);
    };
    const auto wall = known({{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}});
    const auto strip = known({{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.02}});
    const auto spot = known({{3, 0, 0}, {0, 0.02, 0}, {0, 0, 0.02}});
    EXPECT_LT(wall.direction.degrees(), 2.0);
    EXPECT_GT(strip.direction.degrees(), 15.0);
    EXPECT_GT(spot.direction.degrees(), 15.0);
    EXPECT_NEAR(std::sqrt(wall.squared_width), 0.5 / std::sqrt(12), 0.01);
    EXPECT_NEAR(std::sqrt(strip.squared_width), 0.5 / std::sqrt(12), 0.01);
    EXPECT_NEAR(std::sqrt(spot.squared_width), 0.02 / std::sqrt(12), 0.001);
}

/// What adjoins a wall at a right angle is not on its plane.
TEST(points_on_plane, leaves_out_what_adjoins) {
    clouds::cloud points = seen_rectangle{{3, 0, 0}, {0, 0.5, 0}, {0, 0, 0.5}}.points(1);
    for (int i = 0; i < 10; ++i) points.push_back({2.7 + 0.02 * i, 0.25, 0.05 * i});
    points.push_back({clouds::nan, 0.0, 0.0});
    std::vector<gnomon::point_index> all(points.size());
    std::iota(all.begin(), all.end(), gnomon::point_index{0});
    const auto on = gnomon::detail::points_on_plane(points, all, sample_of(points), sigma);
    EXPECT_GE(on.size(), 95u);
    EXPECT_LT(on.back(), 100u);
}

}  // namespace
