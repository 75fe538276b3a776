// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/cast_votes.hpp>

namespace rec = gnomon::recognition;

namespace {

using gnomon::degrees;
using gnomon::rigid_motion;

const gnomon::plane floor_plane{{0.0, 0.0, 1.0}, 0.3};
const Eigen::Vector3d above_floor(4.0, -2.0, 1.0);

/// The sum by its definition: at most 1 of each part.
struct plain_vote {
    double x, y, heading, weight;
    int part;
};
double sum_of(const std::vector<plain_vote>& votes, int parts, double x, double y, double heading,
              const rec::part_votes_options& options) {
    double sum = 0.0;
    for (int p = 0; p < parts; ++p) {
        double of_part = 0.0;
        for (const plain_vote& v : votes) {
            if (v.part != p) continue;
            const double across = std::hypot(v.x - x, v.y - y) / options.reach;
            const double turn = std::remainder(v.heading - heading, 2.0 * std::numbers::pi) /
                                options.turn.radians();
            const double squared = across * across + turn * turn;
            if (squared <= 9.0) of_part += v.weight * std::exp(-0.5 * squared);
        }
        sum += std::min(of_part, 1.0);
    }
    return sum;
}

TEST(cast_votes, sum_at_any_pose_as_their_definition_says) {
    const rec::part_votes_options options;
    gnomon::random_stream random(1);
    rec::cast_votes votes(options, 2);
    std::vector<plain_vote> plain;
    constexpr int parts = 6;
    rigid_motion ground;
    for (int p = 0; p < parts; ++p) {
        ground = votes.begin_part(floor_plane, above_floor);
        for (int k = 0; k < 12; ++k) {
            const double turns = 2.0 * std::numbers::pi * (k % 5 - 2);  // full ones do not matter
            const plain_vote v{random.uniform(-0.6, 0.6), random.uniform(-0.2, 0.2),
                               turns + random.uniform(-0.4, 0.4), random.uniform(0.0, 0.6), p};
            plain.push_back(v);
            votes.add(1, v.x, v.y, v.heading, v.weight);
        }
    }
    for (int trial = 0; trial < 50; ++trial) {
        const double x = random.uniform(-0.3, 0.3), y = random.uniform(-0.3, 0.3),
                     heading = random.uniform(-0.5, 0.5);
        const auto pose = ground * rigid_motion::on_ground(x, y, gnomon::radians(heading));
        EXPECT_NEAR(votes.at(1, pose), sum_of(plain, parts, x, y, heading, options), 1e-12);
        EXPECT_EQ(votes.at(0, pose), 0.0);
        EXPECT_EQ(votes.at(2, pose), 0.0);  // no such object
    }
    const auto places = votes.places(gnomon::threads{2});
    EXPECT_FALSE(places.empty());
    for (const rec::object_place& p : places)
        EXPECT_NEAR(votes.at(p.object, p.pose), p.votes, 1e-9);
}

/// The frame of the ground is below the first part, whatever parts follow.
TEST(cast_votes, are_on_the_ground) {
    rec::cast_votes votes({}, 1);
    const rigid_motion first = votes.begin_part(floor_plane, above_floor);
    EXPECT_NEAR(first.position.z(), 0.3, 1e-12);
    EXPECT_NEAR(first.position.x(), 4.0, 1e-12);
    const rigid_motion second = votes.begin_part(floor_plane, {9.0, 9.0, 2.0});
    EXPECT_EQ(second.position, first.position);
    votes.add(0, 0.5, 0.25, 0.0, 0.9);
    const auto places = votes.places();
    ASSERT_EQ(places.size(), 1u);
    EXPECT_NEAR((places[0].pose.position - first.point_out({0.5, 0.25, 0.0})).norm(), 0.0, 1e-12);
    EXPECT_NEAR(places[0].votes, 0.9, 1e-12);
}

TEST(cast_votes, refuse_bad_options) {
    for (const double bad : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)rec::cast_votes({.reach = bad}, 1), std::invalid_argument);
}

TEST(cast_votes, are_none_of_no_parts) {
    const rec::cast_votes votes({}, 3);
    EXPECT_TRUE(votes.places().empty());
    EXPECT_EQ(votes.at(0, {}), 0.0);
}

}  // namespace
