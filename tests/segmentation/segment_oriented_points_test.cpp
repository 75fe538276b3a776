// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/oriented_dissimilarity_laws.hpp"
#include "laws/partitions.hpp"
#include "segmentation/unit_scenes.hpp"
#include <gnomon/segmentation/segment_oriented_points.hpp>

namespace {

static_assert(gnomon::oriented_dissimilarity<gnomon::two_thresholds>);
static_assert(gnomon::oriented_dissimilarity<gnomon::joint_distance>);
static_assert(!gnomon::oriented_dissimilarity<double>);

const gnomon::two_thresholds thresholds{.radius = 0.025, .max_angle = gnomon::degrees(10)};

std::size_t count(const unit_scenes::scene& s, const auto& dissimilarity, bool greedy = false) {
    return gnomon::segment_oriented_points(s.points, s.surface, dissimilarity, {.greedy = greedy})
        .size();
}

/// Fig. 4.2 (b)-(d)
TEST(segment_oriented_points, separates_corners_and_steps_and_keeps_smooth_surfaces) {
    for (const bool greedy : {false, true}) {
        EXPECT_EQ(count(unit_scenes::corner(), thresholds, greedy), 2u);
        EXPECT_EQ(count(unit_scenes::step(), thresholds, greedy), 2u);
        EXPECT_EQ(count(unit_scenes::smooth(), thresholds, greedy), 1u);
        const gnomon::joint_distance joint{.radius = 0.09};
        EXPECT_EQ(count(unit_scenes::corner(), joint, greedy), 2u);
        EXPECT_EQ(count(unit_scenes::step(), joint, greedy), 2u);
        EXPECT_EQ(count(unit_scenes::smooth(), joint, greedy), 1u);
    }
}

/// Each threshold does one of the two jobs: without it the corner or the step is lost.
TEST(segment_oriented_points, angle_separates_corners_and_distance_separates_steps) {
    gnomon::two_thresholds any_angle = thresholds;
    any_angle.max_angle = gnomon::degrees(90);
    EXPECT_EQ(count(unit_scenes::corner(), any_angle), 1u);
    gnomon::two_thresholds far = thresholds;
    far.radius = 0.15;
    EXPECT_EQ(count(unit_scenes::step(), far), 1u);
}

TEST(segment_oriented_points, equals_the_brute_force_components) {
    const auto s = unit_scenes::smooth();
    const gnomon::two_thresholds tight{.radius = 0.02, .max_angle = gnomon::degrees(2)};
    const auto linked = [&](std::size_t i, std::size_t j) {
        return gnomon::squared_distance(s.points[i], s.points[j]) <= tight.radius * tight.radius &&
               std::abs(s.surface[i].normal.dot(s.surface[j].normal)) >= cos(tight.max_angle);
    };
    const auto expected =
        laws::expected_labels(laws::components_by_brute_force(s.points.size(), linked), 1,
                              [](std::size_t) { return true; });
    EXPECT_EQ(gnomon::segment_oriented_points(s.points, s.surface, tight, {.min_points = 1},
                                              gnomon::threads{2})
                  .labels(),
              expected);
}

TEST(segment_oriented_points, joins_nothing_by_a_missing_normal) {
    auto s = unit_scenes::smooth();
    for (auto& e : s.surface) e.normal.setZero();
    gnomon::two_thresholds any_angle = thresholds;
    any_angle.max_angle = gnomon::degrees(90);
    EXPECT_EQ(count(s, any_angle), 0u);
    EXPECT_EQ(count(s, gnomon::joint_distance{}), 0u);
}

TEST(segment_oriented_points, refuses_bad_arguments) {
    const auto s = unit_scenes::smooth();
    const auto fewer = clouds::in_cube(3, 1);
    EXPECT_THROW((void)gnomon::segment_oriented_points(fewer, s.surface, thresholds),
                 std::invalid_argument);
    EXPECT_THROW((void)count(s, gnomon::joint_distance{.radius = -1}), std::invalid_argument);
    gnomon::two_thresholds obtuse = thresholds;
    obtuse.max_angle = gnomon::degrees(91);
    EXPECT_THROW((void)count(s, obtuse), std::invalid_argument);
    EXPECT_THROW((void)count({}, obtuse), std::invalid_argument);  // though none are compared
}

static_assert(!gnomon::oriented_dissimilarity<double>);

TEST(oriented_dissimilarity, models_obey_the_laws) {
    laws::likeness_is_symmetric(gnomon::two_thresholds{.radius = 0.05});
    laws::likeness_is_symmetric(gnomon::joint_distance{});
}

}  // namespace
