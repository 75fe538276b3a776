// SPDX-License-Identifier: BSL-1.0
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/seen_patch.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/occlusion/detail/plane_comparison.hpp>

namespace {

using gnomon::detail::plane_comparison, gnomon::detail::plane_sample;
using seen::patch, seen::sample_of, seen::seat, seen::sigma;

bool are_of_one(const plane_sample& wide, const plane_sample& slim) {
    return plane_comparison(wide, slim, sigma).is_of_one(gnomon::degrees(15), 0.05);
}

/// How many of 100 scans of two rectangles show them in one plane.
int found_in_one_plane(const patch& wide, const patch& slim) {
    int found = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const auto a = sample_of(wide.points(2 * seed)), b = sample_of(slim.points(2 * seed + 1));
        found += are_of_one(a, b) ? 1 : 0;
    }
    return found;
}

TEST(plane_comparison, finds_parts_of_one_surface_coplanar) {
    EXPECT_GE(found_in_one_plane(seat, {{1.5, 0.6, -0.8}, {0.4, 0, 0}, {0, 0.3, 0}}), 97);
    // No wider than noise.
    EXPECT_GE(found_in_one_plane(seat, {{1.5, 0.4, -0.8}, {0.4, 0, 0}, {0, 0.02, 0}}), 97);
}

TEST(plane_comparison, distinguishes_an_offset_from_noise) {
    EXPECT_EQ(found_in_one_plane(seat, {{1.5, 0.6, -0.83}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
    EXPECT_EQ(found_in_one_plane(seat, {{1.5, 0.6, -0.77}, {0.4, 0, 0}, {0, 0.3, 0}}), 0);
}

/// The legs of a chair a centimeter behind its back: by less than the noise of a range.
TEST(plane_comparison, separates_parallel_planes_a_centimeter_apart) {
    const patch back{{2.0, 0, 0}, {0, 0.4, 0}, {0, 0, 0.4}, 25};
    const Eigen::Vector3d width(0, 0.04, 0), height(0, 0, 0.4);
    EXPECT_GE(found_in_one_plane(back, {{2.0, -0.2, -0.5}, width, height, 12}), 90);
    EXPECT_LE(found_in_one_plane(back, {{2.01, -0.2, -0.5}, width, height, 12}), 15);
}

/// The front of a seat, no higher than noise: the direction of its least spread is that of nothing.
TEST(plane_comparison, separates_an_edge_from_the_surface_it_bounds) {
    const patch front{{1.3, 0.0, -0.82}, {0, 0.4, 0}, {0, 0, 0.04}};
    EXPECT_LE(found_in_one_plane(seat, front), 3);
}

TEST(plane_comparison, takes_an_angle_up_to_the_largest) {
    const auto wall = [](double degrees) {
        const gnomon::angle turned = gnomon::degrees(degrees);
        return patch{{3.0, 0.5, 0.0}, {-0.4 * sin(turned), 0.4 * cos(turned), 0}, {0, 0, 0.4}, 30};
    };
    const patch wide{{3.0, -0.5, 0.0}, {0, 1.0, 0}, {0, 0, 1.0}, 50};
    EXPECT_GE(found_in_one_plane(wide, wall(0.0)), 97);
    EXPECT_GE(found_in_one_plane(wide, wall(10.0)), 97);
    EXPECT_EQ(found_in_one_plane(wide, wall(20.0)), 0);
}

/// What noise cannot have made of one plane is of two; of what is uncertain neither is said.
TEST(plane_comparison, finds_planes_that_certainly_differ) {
    const auto are_of_two = [](const patch& wide, const patch& slim) {
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
TEST(plane_comparison, is_undecided_where_noise_would_hide_an_offset) {
    const patch tile{{3.0, 0.0, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6};
    EXPECT_GE(found_in_one_plane(tile, {{3.0, 0.12, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6}), 97);
    EXPECT_EQ(found_in_one_plane(tile, {{3.0, 1.0, 0.0}, {0, 0.1, 0}, {0, 0, 0.1}, 6}), 0);
}

/// What is hardly wider than noise may be off by that, but never by more than the largest offset.
TEST(plane_comparison, limits_the_offset_of_small_segments) {
    int near = 0;
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
        const patch wall{{3, 0, 0}, {0, 1, 0}, {0, 0, 1}, 40};
        const patch small{{3.015, 0, 0.52}, {0, 0.04, 0}, {0, 0, 0.04}, 14};
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

/// Noise lies along the rays: at grazing incidence it hardly displaces points from their plane,
/// even those of a narrow segment.
TEST(plane_comparison, tolerates_less_at_oblique_incidence) {
    const patch board{{4.0, 0.0, -0.4}, {1.0, 0, 0}, {0, 0.4, 0}};
    const patch beside{{4.0, 0.3, -0.4}, {0.3, 0, 0}, {0, 0.1, 0}};
    const patch above{{4.0, 0.3, -0.385}, {0.3, 0, 0}, {0, 0.1, 0}};
    EXPECT_GE(found_in_one_plane(board, beside), 90);
    EXPECT_LE(found_in_one_plane(board, above), 5);
}

}  // namespace
