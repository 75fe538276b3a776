// SPDX-License-Identifier: BSL-1.0
// Through merge_occluded: what it merges tells what it has seen of a segment.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "occlusion/drawn.hpp"
#include "occlusion/looks.hpp"
#include <gnomon/occlusion/merge_occluded.hpp>

namespace {

using gnomon::visibility, gnomon::merge_occluded, gnomon::segments;
using looks::drawn, looks::element;

/// Something as thick as wide is no wall, be its middle in the wall's plane.
TEST(fragment, is_merged_only_if_flat) {
    drawn wall;
    wall.add({3, -0.5, 0}, 50, 50);
    wall.add({3, 0.35, 0}, 25, 30, 20);
    EXPECT_TRUE(wall.merged().gaps.empty());
    EXPECT_EQ(wall.merged({.max_variation = 1.0}).gaps.size(), 1u);
}

/// A wall of which some went round a corner is flat, if most of it is a wall.
TEST(fragment, is_flat_but_for_a_corner) {
    for (const auto& [deep, rest] : {std::pair(12, 1u), {16, 2u}}) {
        drawn wall;
        wall.add({3, 0.36, 0}, 25, 20);
        // Round the corner, to both sides, with 22 or 29 in 100 of the points off the plane.
        wall.add({3, 0.62, 0}, 1, 20, deep);
        for (std::int32_t& label : wall.labels) label = 0;
        wall.add({3, -0.5, 0}, 50, 50);
        const auto merged = wall.merged({.max_variation = 0.001});
        EXPECT_EQ(merged.gaps.size(), 2 - rest);
        EXPECT_EQ(merged.segments.size(), rest);
    }
}

/// Two strips hardly wider than noise, side by side, say little of their planes: their normals do.
TEST(fragment, is_adjacent_to_segments_with_similar_normals) {
    drawn strips;
    strips.add({3, -0.03, 0}, 2, 20);
    strips.add({3, 0.03, 0}, 2, 20);
    const segments parts(strips.labels);
    const visibility visible(strips.points);
    const auto rest = [&](double degrees) {
        const gnomon::angle turned = gnomon::degrees(degrees);
        std::vector<element> surface(40, {{-1.0, 0.0, 0.0}});
        surface.resize(80, {{-cos(turned), sin(turned), 0.0}});
        surface[3].normal.setZero();
        surface[7].normal.setConstant(std::numeric_limits<double>::quiet_NaN());
        return merge_occluded(strips.points, surface, parts, visible).segments.size();
    };
    for (const double alike : {0.0, 30.0, 44.0}) EXPECT_EQ(rest(alike), 1u) << alike;
    for (const double unlike : {46.0, 90.0, 180.0}) EXPECT_EQ(rest(unlike), 2u) << unlike;
    const std::vector<element> none(80, {{0.0, 0.0, 0.0}});
    EXPECT_EQ(merge_occluded(strips.points, none, parts, visible).segments,
              merge_occluded(strips.points, parts, visible).segments);
    EXPECT_EQ(strips.merged().segments.size(), 1u);
}

/// A spot narrower than noise has normals of noise: it goes on in a wall, but not in another spot.
TEST(fragment, narrower_than_noise_is_merged_only_with_a_wide_segment) {
    drawn spots;
    spots.add({3, 0, 0}, 2, 2, 3);
    spots.add({3, 0.1, 0}, 2, 2, 3);
    EXPECT_EQ(spots.merged().segments.size(), 2u);

    drawn wall;
    wall.add({3, -0.5, 0}, 50, 50);
    wall.add({3, 0.1, 0}, 2, 2, 3);
    std::vector<element> surface(2500, {{-1.0, 0.0, 0.0}});
    surface.resize(2512, {{0.0, 1.0, 0.0}});
    EXPECT_EQ(merge_occluded(wall.points, surface, segments(wall.labels), visibility(wall.points))
                  .segments.size(),
              1u);
}

/// A fragment above a piece of furniture that has lent it some points, the nearest to the wall
/// among them: between these and the wall the wall itself seems to be seen through a gap.
TEST(fragment, starts_gaps_on_its_plane) {
    drawn wall;
    wall.add({3, 0, 0.8}, 80, 40);
    wall.add({3, 0, -0.25}, 20, 15);
    wall.add({2.8, 0, 0.0}, 20, 2);
    for (std::int32_t& label : wall.labels) label = std::min(label, 1);
    const auto merged = wall.merged({.max_gap = 0.6});
    EXPECT_EQ(merged.segments.size(), 1u);
    ASSERT_EQ(merged.gaps.size(), 1u);
    for (const auto& line : merged.gaps[0].lines) EXPECT_EQ(wall.points[line.second].x(), 3.0);
}

/// What hides the gap tells more than normals, which are of points on both sides of an edge.
TEST(fragment, ignores_normals_across_an_occluded_gap) {
    const auto seen = looks::look_at(looks::hidden());
    const auto parts = looks::halves(seen);
    std::vector<element> surface;
    for (const std::int32_t label : parts.labels())
        surface.push_back({label == 0 ? Eigen::Vector3d(-1, 0, 0) : Eigen::Vector3d(0, 1, 0)});
    const visibility visible(seen.scan);
    EXPECT_EQ(merge_occluded(seen.scan, surface, parts, visible).segments,
              merge_occluded(seen.scan, parts, visible).segments);
    EXPECT_EQ(merge_occluded(seen.scan, surface, parts, visible).segments.size(), 1u);
}

}  // namespace
