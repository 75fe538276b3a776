// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <stdexcept>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/occlusion/literal_merging.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>

namespace {

using gnomon::conservative, gnomon::liberal, gnomon::visibility, gnomon::merge_occluded_literally,
    gnomon::segments;

/// How many segments the two halves of a wall make.
std::size_t remaining_literally(const looks::look& seen, const auto& policy,
                                const gnomon::literal_merging_options& options = {}) {
    return merge_occluded_literally(seen.scan, looks::halves(seen), visibility(seen.scan), policy,
                                    options)
        .size();
}

/// Fig. 4.4: what is seen in a gap of 60 cm, and who merges.
TEST(merge_occluded_literally, follows_the_truth_table_of_the_policies) {
    const auto closer = looks::look_at(looks::hidden());
    const auto farther = looks::look_at(looks::opened(0.6));
    const auto nothing = looks::look_at(looks::torn(0.6));
    EXPECT_EQ(remaining_literally(closer, conservative{}), 1u);
    EXPECT_EQ(remaining_literally(closer, liberal{}), 1u);
    EXPECT_EQ(remaining_literally(farther, conservative{}), 2u);
    EXPECT_EQ(remaining_literally(farther, liberal{}), 2u);
    EXPECT_EQ(remaining_literally(nothing, conservative{}), 2u);
    EXPECT_EQ(remaining_literally(nothing, liberal{}), 1u);
}

/// Line 8. merge_occluded tests what is seen in the gap instead (docs/thesis-notes.md, A18).
TEST(merge_occluded_literally, closes_a_narrow_gap_whatever_is_seen_in_it) {
    const auto seen = looks::look_at(looks::opened(0.1));
    EXPECT_EQ(remaining_literally(seen, conservative{}), 1u);
    EXPECT_EQ(remaining_literally(seen, conservative{}, {.max_gap = 0.0}), 2u);
    EXPECT_EQ(gnomon::merge_occluded(seen.scan, looks::halves(seen), visibility(seen.scan))
                  .segments.size(),
              2u);
}

/// Lines 12 and 13 use single view points; merge_occluded also handles view points that move.
TEST(merge_occluded_literally, does_not_combine_view_points) {
    const auto seen =
        looks::look_at(looks::hidden(), {.first = {0, 0.5, 0}, .step = {0, -0.01, 0}});
    EXPECT_EQ(remaining_literally(seen, liberal{}), 2u);
}

/// View points that noise makes one share an image, and what both have seen is in it.
TEST(merge_occluded_literally, shares_images_of_view_points_closer_than_noise) {
    const auto seen =
        looks::look_at(looks::hidden(), {.first = {0, 0.003, 0}, .step = {0, -0.0001, 0}});
    EXPECT_EQ(remaining_literally(seen, conservative{}), 1u);
}

/// Numbers that no segment has are no segments, however many.
TEST(merge_occluded_literally, passes_over_empty_segments) {
    const auto seen = looks::look_at(looks::hidden());
    std::vector<std::int32_t> labels = looks::halves(seen).labels();
    for (std::int32_t& l : labels)
        if (l != gnomon::unlabeled) l += 400;
    EXPECT_EQ(
        merge_occluded_literally(seen.scan, segments(labels), visibility(seen.scan), conservative{})
            .size(),
        1u);
    EXPECT_EQ(gnomon::merge_occluded(seen.scan, segments(labels), visibility(seen.scan),
                                     conservative{}, {.candidates = 1})
                  .segments.size(),
              1u);
}

TEST(merge_occluded_literally, refuses_thresholds_of_no_sense) {
    const auto seen = looks::look_at(looks::hidden(), {.spacing = 4.0});
    const auto refused = [&](const gnomon::literal_merging_options& options) {
        EXPECT_THROW((void)remaining_literally(seen, conservative{}, options),
                     std::invalid_argument);
    };
    refused({.max_variation = -1.0});
    refused({.max_angle = gnomon::degrees(-1)});
    refused({.max_offset = clouds::nan});
    refused({.max_gap = -1.0});
    refused({.boundary_pairs = 3});
}

TEST(merge_occluded_literally, has_the_defaults_of_the_thesis) {
    const gnomon::literal_merging_options options;
    EXPECT_DOUBLE_EQ(options.max_variation, 0.15);
    EXPECT_DOUBLE_EQ(options.max_angle.degrees(), 15.0);
    EXPECT_DOUBLE_EQ(options.max_offset, 0.05);
    EXPECT_DOUBLE_EQ(options.max_gap, 0.20);
    EXPECT_EQ(options.boundary_pairs, 6u);
}

TEST(merge_occluded_literally, keeps_segments_that_are_not_coplanar) {
    gnomon::simulation::scene world;
    looks::add_wall(world, -2.0, 0.0);
    looks::add_wall(world, 0.0, 2.0, 3.07);
    EXPECT_EQ(remaining_literally(looks::look_at(world), liberal{}), 2u);
}

TEST(merge_occluded_literally, refuses_segments_of_other_points) {
    const auto seen = looks::look_at(looks::hidden(), {.spacing = 4.0});
    EXPECT_THROW((void)merge_occluded_literally(seen.scan, segments(), visibility(seen.scan)),
                 std::invalid_argument);
}

/// From the first pixel to the last, each next to the one before, by the shorter way around.
TEST(pixels_between, go_the_shorter_way_around) {
    const clouds::cloud one{{1, 0, 0}};
    const gnomon::range_image image(one, looks::origin, {.width = 20, .height = 10});
    using pixel = gnomon::range_image::pixel;
    for (const auto& [from, to, steps] :
         {std::tuple(pixel{18, 2}, pixel{2, 3}, 4u), std::tuple(pixel{2, 3}, pixel{18, 2}, 4u),
          std::tuple(pixel{4, 1}, pixel{6, 8}, 7u), std::tuple(pixel{5, 5}, pixel{5, 5}, 0u)}) {
        std::vector<pixel> line;
        std::vector<double> shares;
        gnomon::detail::for_each_pixel_between(image, from, to, [&](const pixel& at, double share) {
            line.push_back(at);
            shares.push_back(share);
        });
        ASSERT_EQ(line.size(), steps + 1);
        EXPECT_EQ(line.front(), from);
        EXPECT_EQ(line.back(), to);
        EXPECT_EQ(shares.front(), 0.0);
        EXPECT_EQ(shares.back(), steps == 0 ? 0.0 : 1.0);
        for (std::size_t s = 1; s < line.size(); ++s) {
            const std::size_t across = (line[s].azimuth + 21 - line[s - 1].azimuth) % 20;
            const std::size_t up = line[s].elevation + 1 - line[s - 1].elevation;
            EXPECT_LE(across, 2u);
            EXPECT_LE(up, 2u);
        }
    }
}

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
    const auto a = gnomon::principal_frame::of(rectangle({0, 0, 1}, 0.0));
    const auto b = gnomon::principal_frame::of(rectangle({3, 4, 1}, 0.0));
    EXPECT_NEAR(angular_distance(a, b), 0.0, 1e-12);
    EXPECT_NEAR(orthogonal_distance(a, b), 0.0, 1e-12);
    EXPECT_EQ(orthogonal_distance(a, a), 0.0);
}

TEST(segment_distances, are_those_of_parallel_rectangles) {
    const auto a = gnomon::principal_frame::of(rectangle({0, 0, 1}, 0.0));
    const auto b = gnomon::principal_frame::of(rectangle({3, 0, 1.04}, 0.0));
    EXPECT_NEAR(orthogonal_distance(a, b), 0.04, 1e-12);
    EXPECT_NEAR(angular_distance(a, b), 0.0, 1e-12);
}

/// The second centroid lies in the plane of the first, which is 3 sin(t) from that of the second.
TEST(segment_distances, take_the_smaller_distance_of_a_plane) {
    for (const double t : {1e-7, 0.1, 0.7, 0.5 * std::numbers::pi}) {
        const auto a = gnomon::principal_frame::of(rectangle({0, 0, 0}, 0.0));
        const auto b = gnomon::principal_frame::of(rectangle({3, 0, 0}, t));
        EXPECT_NEAR(angular_distance(a, b), t, 1e-12);
        EXPECT_NEAR(orthogonal_distance(a, b), 0.0, 1e-12);
        const auto c = gnomon::principal_frame::of(rectangle({3, 0, 0.5}, t));
        const double from_other = std::abs(3.0 * std::sin(t) - 0.5 * std::cos(t));
        EXPECT_NEAR(orthogonal_distance(a, c), std::min(0.5, from_other), 1e-12);
    }
}

/// An obtuse angle between normals is an acute one between planes.
TEST(segment_distances, know_no_sides_of_planes) {
    auto a = gnomon::principal_frame::of(rectangle({0, 0, 0}, 0.0));
    const auto b = gnomon::principal_frame::of(rectangle({1, 0, 0.2}, 0.3));
    const double angle = angular_distance(a, b), offset = orthogonal_distance(a, b);
    a.axes.col(2) *= -1.0;
    EXPECT_DOUBLE_EQ(angular_distance(a, b), angle);
    EXPECT_DOUBLE_EQ(orthogonal_distance(a, b), offset);
}

TEST(segment_distances, are_symmetric_and_stay_under_rigid_motion) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const auto first = clouds::sheet(60, seed);
        const auto second = clouds::sheet(40, seed + 100);
        const auto a = gnomon::principal_frame::of(first);
        const auto b = gnomon::principal_frame::of(second);
        EXPECT_DOUBLE_EQ(angular_distance(a, b), angular_distance(b, a));
        EXPECT_DOUBLE_EQ(orthogonal_distance(a, b), orthogonal_distance(b, a));
        const auto r = clouds::random_rotation(seed);
        for (const Eigen::Vector3d& t : {Eigen::Vector3d(1, 2, 3), {6e5, 4.8e6, 100}}) {
            const auto c = gnomon::principal_frame::of(clouds::moved(first, r, t));
            const auto d = gnomon::principal_frame::of(clouds::moved(second, r, t));
            EXPECT_NEAR(angular_distance(c, d), angular_distance(a, b), 1e-7);
            EXPECT_NEAR(orthogonal_distance(c, d), orthogonal_distance(a, b), 1e-7);
        }
    }
}

}  // namespace
