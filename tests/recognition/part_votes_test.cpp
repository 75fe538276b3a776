// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <boost/hana/tuple.hpp>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/part_features.hpp>
#include <gnomon/recognition/part_votes.hpp>
#include <gnomon/recognition/view.hpp>

namespace rec = gnomon::recognition;

namespace {

using gnomon::degrees;
using gnomon::rigid_motion;

/// A board as a part of a view, in the frame of an object that stands on z = 0.
struct board {
    Eigen::Vector3d center, normal, along;  // unit vectors
    double length, width;
};

/// What a chair looks like: a seat, and a back at -x that is seen from the front.
const std::vector<board> chair_boards{{{0.0, 0.06, 0.45}, {0, 0, 1}, {0, 1, 0}, 0.50, 0.30},
                                      {{-0.2, 0.06, 0.75}, {1, 0, 0}, {0, 1, 0}, 0.50, 0.35}};
/// A table: one level board, much longer than wide.
const std::vector<board> table_boards{{{0.1, 0.05, 0.72}, {0, 0, 1}, {1, 0, 0}, 1.40, 0.70}};

/// A view of boards at a pose of their object.
rec::view view_of_boards(const std::vector<board>& boards, const rigid_motion& pose,
                         const rigid_motion& world = {}) {
    const rigid_motion all = world * pose;
    rec::view v;
    const Eigen::Vector3d up = world.direction_out({0, 0, 1});
    v.ground = gnomon::plane{up, up.dot(world.position)};
    for (const board& b : boards) {
        rec::part p;
        p.shape.spread = gnomon::segment_shape::extent::plane;
        p.shape.normal = all.direction_out(b.normal);
        auto& frame = p.shape.frame;
        frame.centroid = frame.box_center = all.point_out(b.center);
        frame.axes.col(0) = all.direction_out(b.along);
        frame.axes.col(1) = all.direction_out(b.normal.cross(b.along));
        frame.axes.col(2) = p.shape.normal;
        frame.box_size = {b.length, b.width, 0.01};
        const double half = std::abs(b.normal.z()) > 0.5 ? 0.01 : 0.5 * b.width;
        p.lowest = b.center.z() - half;
        p.highest = b.center.z() + half;
        v.parts.push_back(p);
    }
    return v;
}

rec::part_votes<> votes_for_chair_and_table() {
    rec::part_votes<> votes;
    for (int k = 0; k < 12; ++k) {
        const auto pose = rigid_motion::on_ground(2.0 + 0.1 * k, 0.3 * k - 1.0, degrees(31.0 * k));
        votes.learn(view_of_boards(chair_boards, pose), pose, 0);
        votes.learn(view_of_boards(table_boards, pose), pose, 1);
    }
    return votes;
}

/// The difference of two headings [deg].
double turn_between(const rigid_motion& a, const rigid_motion& b) {
    const Eigen::Vector3d x = b.direction_in(a.direction_out({1, 0, 0}));
    return std::abs(std::atan2(x.y(), x.x())) * 180.0 / std::numbers::pi;
}

/// Wherever it stands, whatever the frame of the scan is, tilted or far away: the same place.
TEST(part_votes, find_the_place_of_an_object_in_any_frame) {
    const auto votes = votes_for_chair_and_table();
    rigid_motion tilted;
    tilted.rotation =
        Eigen::AngleAxisd(0.4, Eigen::Vector3d(1, 2, 0).normalized()).toRotationMatrix();
    tilted.position = {4e5, 5e6, 300};
    for (const rigid_motion& world : {rigid_motion{}, tilted}) {
        for (const double yaw : {0.0, 50.0, 170.0, -100.0}) {
            const auto pose = rigid_motion::on_ground(1.0, -2.0, degrees(yaw));
            const std::vector views{view_of_boards(chair_boards, pose, world)};
            const auto places = votes.places(views);
            ASSERT_FALSE(places.empty());
            const rec::object_place& best = places.front();
            EXPECT_EQ(best.object, 0u);
            EXPECT_NEAR((best.pose.position - (world * pose).position).norm(), 0.0, 1e-5);
            EXPECT_NEAR(turn_between(best.pose, world * pose), 0.0, 1e-4);
            EXPECT_NEAR(best.pose.direction_out({0, 0, 1}).dot(world.direction_out({0, 0, 1})), 1.0,
                        1e-9);
            EXPECT_NEAR(best.votes, 2.0, 0.1);  // of both boards
        }
    }
}

/// A long board is the same after half a turn: both places are hypotheses.
TEST(part_votes, are_for_all_headings_that_a_part_allows) {
    const auto votes = votes_for_chair_and_table();
    const auto pose = rigid_motion::on_ground(0.5, 1.0, degrees(20));
    const auto places = votes.places(std::vector{view_of_boards(table_boards, pose)});
    std::vector<double> turns;
    for (const auto& p : places)
        if (p.object == 1 && p.votes > 0.9) turns.push_back(turn_between(p.pose, pose));
    std::ranges::sort(turns);
    ASSERT_EQ(turns.size(), 2u);
    EXPECT_NEAR(turns[0], 0.0, 1e-4);
    EXPECT_NEAR(turns[1], 180.0, 1e-4);
}

/// Objects that touch, in one view, have a place each.
TEST(part_votes, of_one_view_find_several_objects) {
    const auto votes = votes_for_chair_and_table();
    const auto first = rigid_motion::on_ground(1.0, 0.0, degrees(0));
    const auto second = rigid_motion::on_ground(1.0, 0.5, degrees(180));
    rec::view both = view_of_boards(chair_boards, first);
    for (const auto& p : view_of_boards(chair_boards, second).parts) both.parts.push_back(p);
    const auto places = votes.places(std::vector{both});
    for (const auto& pose : {first, second}) {
        EXPECT_TRUE(std::ranges::any_of(places, [&](const auto& p) {
            return p.object == 0 && p.votes > 1.9 &&
                   (p.pose.position - pose.position).norm() < 0.01 &&
                   turn_between(p.pose, pose) < 1.0;
        }));
    }
}

TEST(part_votes, do_not_depend_on_threads) {
    const auto votes = votes_for_chair_and_table();
    const std::vector views{
        view_of_boards(chair_boards, rigid_motion::on_ground(1.0, 0.0, degrees(10))),
        view_of_boards(table_boards, rigid_motion::on_ground(3.0, 1.0, degrees(70)))};
    const auto alone = votes.places(views);
    const auto places = votes.votes(views, gnomon::threads{3}).places();
    ASSERT_EQ(places.size(), alone.size());
    ASSERT_FALSE(alone.empty());
    for (std::size_t i = 0; i < alone.size(); ++i) {
        EXPECT_EQ(places[i].object, alone[i].object);
        EXPECT_EQ(places[i].pose.position, alone[i].pose.position);
        EXPECT_EQ(places[i].votes, alone[i].votes);
    }
}

TEST(part_votes, are_none_for_parts_that_are_not_known) {
    const auto votes = votes_for_chair_and_table();
    const std::vector<board> shelf{{{0, 0, 1.7}, {1, 0, 0}, {0, 1, 0}, 3.0, 2.0}};
    EXPECT_TRUE(votes.places(std::vector{view_of_boards(shelf, {})}).empty());
    EXPECT_TRUE(votes.places({}).empty());
    EXPECT_TRUE(rec::part_votes<>{}.places(std::vector{view_of_boards(shelf, {})}).empty());
}

TEST(part_votes, need_a_ground) {
    auto votes = votes_for_chair_and_table();
    rec::view v = view_of_boards(chair_boards, {});
    v.ground = std::nullopt;
    const std::size_t before = votes.samples().size();
    EXPECT_THROW(votes.learn(v, {}, 0), std::invalid_argument);
    EXPECT_EQ(votes.samples().size(), before);
    EXPECT_THROW(static_cast<void>(votes.places(std::vector{v})), std::invalid_argument);
}

TEST(part_votes, refuse_options_and_poses_that_are_not_valid) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const auto& options :
         {rec::part_votes_options{.nearest = 0}, rec::part_votes_options{.likeness = 0.0},
          rec::part_votes_options{.reach = nan}, rec::part_votes_options{.turn = degrees(0)},
          rec::part_votes_options{.max_distance = -1.0}, rec::part_votes_options{.min_votes = nan}})
        EXPECT_THROW(rec::part_votes<>{options}, std::invalid_argument);
    rec::part_votes<> votes;
    rigid_motion skewed;
    skewed.rotation(0, 1) = 0.5;
    EXPECT_THROW(votes.learn(view_of_boards(chair_boards, {}), skewed, 0), std::invalid_argument);
    EXPECT_THROW(
        votes.learn(view_of_boards(chair_boards, {}), {}, std::numeric_limits<std::size_t>::max()),
        std::invalid_argument);
    rec::view v = view_of_boards(chair_boards, {});
    v.ground->normal = {0.0, 0.0, 0.0};
    EXPECT_THROW(votes.learn(v, {}, 0), std::invalid_argument);
    EXPECT_TRUE(votes.samples().empty());
    auto ignored = boost::hana::make_tuple(rec::mean_height{.weight = 0.0});
    EXPECT_THROW(rec::part_votes({}, ignored), std::invalid_argument);
}

/// Places of parts are no features, which are checked.
TEST(part_votes, refuse_parts_without_a_place) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    auto votes = votes_for_chair_and_table();
    const std::size_t before = votes.samples().size();
    rec::view nowhere = view_of_boards(chair_boards, {}), unturned = nowhere;
    nowhere.parts[0].shape.frame.box_center.x() = nan;
    unturned.parts[0].shape.normal.x() = nan;
    for (const rec::view& v : {nowhere, unturned}) {
        EXPECT_THROW(votes.learn(v, {}, 0), std::invalid_argument);
        EXPECT_THROW(static_cast<void>(votes.places(std::vector{v})), std::invalid_argument);
    }
    EXPECT_EQ(votes.samples().size(), before);
}

}  // namespace
