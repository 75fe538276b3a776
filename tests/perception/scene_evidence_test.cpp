// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>

#include <gtest/gtest.h>

#include "chair_in_scene.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/perception/detail/alignment_effort.hpp>
#include <gnomon/perception/detail/object_probability.hpp>
#include <gnomon/perception/detail/pose_search.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>

namespace {

using namespace one_chair;

/// A neighbor that touches an object does not pull it away from where it is, as it does if surfaces
/// correspond that are farther apart.
TEST(scene_evidence, keeps_objects_where_they_are_next_to_a_neighbor) {
    const chair_in_scene chair(narrow, narrow,
                               where_chair_is * rigid_motion::on_ground(0.0, 0.45, degrees(90.0)));
    const auto off = [&](const rec::detail::alignment_effort& much) {
        return distance_off(chair.scene().aligned(0, where_chair_is, chair.surfaces()[0], much));
    };
    EXPECT_LT(off(rec::detail::careful_effort), 0.01);
    auto farther = rec::detail::careful_effort;
    farther.max_distance = rec::detail::rough_effort.max_distance;
    EXPECT_GT(off(farther), 0.03);
}

/// A better pose is looked for with fewer counts, but the answer is that of all of them. Where
/// there are too few cells, nothing fits better.
TEST(scene_evidence, compares_poses_as_by_complete_counts) {
    const chair_in_scene chair;
    const auto& scene = chair.scene();
    const auto& model = chair.surfaces()[0];
    const auto rough = rec::detail::rough_effort;
    std::size_t better = 0, others = 0;
    for (const double from : {0.0, 0.05, 0.3, 9.0}) {
        auto than = scene.aligned(
            0, where_chair_is * rigid_motion::on_ground(from, 0.0, degrees(0.0)), model, rough);
        if (from > 1.0) than.evidence.seen_through = 1000;
        for (const double x : {-0.2, -0.08, 0.0, 0.08, 7.0}) {
            const auto start = where_chair_is * rigid_motion::on_ground(x, 0.02, degrees(50.0 * x));
            const auto complete = scene.aligned(0, start, model, rough);
            const auto found = scene.verified_better(
                than, scene.only_aligned(0, start, model, rough), model, rough);
            const bool is_better = complete.evidence.samples > 0 &&
                                   rec::detail::fits_better(complete.evidence, than.evidence);
            ASSERT_EQ(found.has_value(), is_better);
            ++(is_better ? better : others);
            if (!is_better) continue;
            EXPECT_EQ(found->aligned.pose.position, complete.aligned.pose.position);
            EXPECT_EQ(found->probability, complete.probability);
            EXPECT_EQ(found->evidence.supported, complete.evidence.supported);
            EXPECT_EQ(found->evidence.explained, complete.evidence.explained);
        }
    }
    EXPECT_GT(better, 0u);
    EXPECT_GT(others, 0u);
}

/// The surface of an object is found in the cells that are left, and in none of those that are not.
TEST(scene_evidence, searches_surfaces_in_what_is_left) {
    const chair_in_scene chair;
    const auto places_in = [&](bool is_left) {
        return chair.scene().searched_places(
            chair.surfaces(), [&](gnomon::point_index) { return is_left; }, gnomon::sequential{});
    };
    EXPECT_TRUE(places_in(false).empty());
    const auto places = places_in(true);
    EXPECT_LE(places.size(), rec::detail::pose_search::most);
    EXPECT_TRUE(std::ranges::any_of(places, [](const rec::object_place& p) {
        return (p.pose.position - where_chair_is.position).norm() < 0.15;
    }));
}

/// What was compared by its silhouette is more probable the better this agrees, and less the more a
/// surface goes on beyond it or the sensor saw through; without rays, samples decide.
TEST(scene_evidence, corrects_probabilities_by_silhouettes) {
    rec::found_object o;
    o.evidence = {.samples = 500, .facing = 300, .supported = 200, .mismatched = 20, .hidden = 80};
    o.evidence.points = o.evidence.near_surface = 300;
    o.evidence.explained = o.evidence.on_surface = 280;
    o.votes = 0.5;
    const double by_samples = rec::detail::probability_of(o);
    o.silhouette = {.rays = 0, .overlap = 0.9, .beyond = 0.0};
    EXPECT_EQ(rec::detail::probability_of(o), by_samples);
    o.silhouette.rays = 800;
    const double good = rec::detail::probability_of(o);
    EXPECT_GT(good, 0.9);
    auto worse = o;
    worse.silhouette.overlap = 0.5;
    EXPECT_LT(rec::detail::probability_of(worse), good);
    worse = o;
    worse.silhouette.beyond = 0.9;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    worse = o;
    worse.evidence.seen_through = 50;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    EXPECT_TRUE(rec::detail::fits_better(o.evidence, worse.evidence));
    worse = o;
    worse.evidence.in_walls = 50;
    EXPECT_LT(rec::detail::probability_of(worse), 0.5);
    EXPECT_TRUE(rec::detail::fits_better(o.evidence, worse.evidence));
    const chair_in_scene chair(wide, wide);
    auto found =
        chair.scene().aligned(0, where_chair_is, chair.surfaces()[0], rec::detail::careful_effort);
    chair.scene().compare_silhouette(found, chair.surfaces()[0]);
    EXPECT_GT(found.silhouette.rays, 100u);
    EXPECT_GT(found.silhouette.overlap, 0.7);
    EXPECT_EQ(found.probability, rec::detail::probability_of(found));
}

}  // namespace
