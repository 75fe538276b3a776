// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "chair_in_scene.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/perception/detail/alignment_effort.hpp>
#include <gnomon/perception/detail/object_hypotheses.hpp>
#include <gnomon/perception/detail/scene_evidence.hpp>
#include <gnomon/perception/found_object.hpp>
#include <gnomon/recognition/cast_votes.hpp>

namespace {

using namespace one_chair;

/// Places from which the alignment comes to one pose are one hypothesis, at the pose that fits.
TEST(object_hypotheses, are_one_at_each_pose) {
    const chair_in_scene chair;
    std::vector<rec::object_place> places;
    for (const double x : {-0.03, 0.0, 0.03})
        for (const double y : {-0.03, 0.0, 0.03})
            places.push_back(
                {0, where_chair_is * rigid_motion::on_ground(x, y, degrees(100.0 * x)), 0.0});
    const auto found = chair.hypotheses_at(places, gnomon::threads{2});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(distance_off(found[0]), 0.01);
    EXPECT_GT(found[0].evidence.samples, 500u);  // verified carefully
}

/// A rough alignment from a place that is far off is hardly probable: only with a lower limit is it
/// improved, and then found where the chair is.
TEST(object_hypotheses, are_improved_from_a_least_probability_on) {
    const chair_in_scene chair;
    const std::vector<rec::object_place> place{
        {0, where_chair_is * rigid_motion::on_ground(0.12, -0.16, degrees(0.0)), 0.0}};
    EXPECT_TRUE(chair.hypotheses_at(place, gnomon::sequential{}).empty());
    const auto found = chair.hypotheses_at(place, gnomon::sequential{}, 0.002);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(distance_off(found[0]), 0.01);
}

/// Where an object ends along x, improved from the origin, if it fits best at x [m].
/// @param probability  of the object at all poses
double improved_to(double x, double probability) {
    rec::found_object at_origin;
    at_origin.probability = probability;
    const auto off = [x](const rigid_motion& at) {
        return std::abs(at.position.x() - x) + at.position.tail<2>().norm();
    };
    const auto better_from = [&](const rec::found_object& best,
                                 const rigid_motion& start) -> std::optional<rec::found_object> {
        if (off(start) > 0.17 || off(start) >= off(best.aligned.pose)) return std::nullopt;
        rec::found_object next = best;
        next.aligned.pose = start;
        return next;
    };
    return rec::detail::improved(at_origin, better_from).aligned.pose.position.x();
}

/// Tops of tables slide along themselves, by more than one step.
TEST(object_hypotheses, are_improved_from_starts_farther_away) {
    for (const double x : {-0.16, -0.08, 0.08, 0.16, 0.32})
        EXPECT_NEAR(improved_to(x, 0.5), x, 1e-9);
}

/// A hypothesis that is not worth it after one round of improvements gets no further one.
TEST(object_hypotheses, are_given_up_if_the_first_round_does_not_help) {
    EXPECT_NEAR(improved_to(0.32, 0.005), 0.16, 1e-9);
}

/// Far from all points there is none.
TEST(object_hypotheses, are_none_where_nothing_is) {
    const chair_in_scene chair;
    const std::vector<rec::object_place> places{
        {0, rigid_motion::on_ground(9.0, 9.0, degrees(0.0)), 0.0}};
    EXPECT_TRUE(chair.hypotheses_at(places, gnomon::sequential{}).empty());
}

/// What is found settles at the true pose, as probable as before, from one 9 cm away at which
/// it was left.
TEST(object_hypotheses, settle_where_they_fit_best) {
    const chair_in_scene chair;
    std::vector<rec::found_object> found(1);
    found[0].aligned.pose = where_chair_is * rigid_motion::on_ground(0.0, 0.09, degrees(0.0));
    found[0].evidence.samples = found[0].evidence.seen_through = 1000;
    found[0].probability = 0.7;
    rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
    EXPECT_LT(distance_off(found[0]), 0.01);
    EXPECT_EQ(found[0].probability, 0.7);
    EXPECT_GT(found[0].evidence.supported, 10 * found[0].evidence.seen_through);
    EXPECT_GT(found[0].silhouette.overlap, 0.7);  // that of the pose at which it settled
}

/// A chair that was left facing the other way, with its back where the back is, turns around.
TEST(object_hypotheses, settle_facing_the_other_way) {
    const chair_in_scene chair;
    const rec::surface_model& model = chair.surfaces()[0];
    const auto turned = rigid_motion::on_ground(2.0 * model.low().x(), 0.0, degrees(180.0));
    std::vector<rec::found_object> found{
        chair.scene().aligned(0, where_chair_is * turned, model, rec::detail::careful_effort)};
    EXPECT_GT(distance_off(found[0]), 0.2);
    found[0].probability = 0.7;
    rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
    EXPECT_LT(distance_off(found[0]), 0.01);
}

/// Beams that average at edges shift the pose away from the sensor. The points that whole beams hit
/// do not, and their covariance holds.
TEST(object_hypotheses, settle_by_whole_beams) {
    const auto settled_for = [&](gnomon::angle assumed) {
        const chair_in_scene chair(wide, assumed);
        const auto start = where_chair_is * rigid_motion::on_ground(0.01, 0.0, degrees(1.0));
        std::vector<rec::found_object> found{
            chair.scene().aligned(0, start, chair.surfaces()[0], rec::detail::careful_effort)};
        rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
        return found[0].aligned;
    };
    const auto error_of = [&](const gnomon::alignment& a) {
        return Eigen::Vector3d(where_chair_is.point_out(a.pose.point_in(a.center)) - a.center);
    };
    const auto by_all = settled_for(narrow), by_whole = settled_for(wide);
    ASSERT_TRUE(by_whole.is_usable());
    EXPECT_LT(by_whole.points, by_all.points);
    const Eigen::Vector3d away =
        Eigen::Vector3d(by_all.center.x(), by_all.center.y(), 0.0).normalized();
    EXPECT_LT(error_of(by_all).dot(away), -0.001);  // the chair is nearer than estimated
    EXPECT_LT(error_of(by_whole).norm(), 0.5 * error_of(by_all).norm());
    for (const int a : {3, 4})
        EXPECT_LT(std::abs(error_of(by_whole)[a - 3]), 4.0 * std::sqrt(by_whole.covariance(a, a)));
}

/// Where no whole beam hits the object, it stays where it is, less certain.
TEST(object_hypotheses, stay_without_whole_beams) {
    const auto settled_for = [&](gnomon::angle assumed) {
        const chair_in_scene chair(narrow, assumed);
        std::vector<rec::found_object> found{chair.scene().aligned(
            0, where_chair_is, chair.surfaces()[0], rec::detail::careful_effort)};
        rec::detail::settle(found, chair.scene(), chair.surfaces(), gnomon::sequential{});
        return found;
    };
    const auto sharp = settled_for(narrow), blurred = settled_for(degrees(45.0));
    EXPECT_EQ(blurred[0].aligned.pose.position, sharp[0].aligned.pose.position);
    EXPECT_LT(distance_off(sharp[0]), 0.01);
    EXPECT_TRUE(sharp[0].aligned.is_usable());
    for (const int a : {3, 4})
        EXPECT_GT(blurred[0].aligned.covariance(a, a), sharp[0].aligned.covariance(a, a) + 0.01);
}

}  // namespace
