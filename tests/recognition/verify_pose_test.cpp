// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <vector>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "recognition/room_views.hpp"
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/recognition/verify_pose.hpp>
#include <gnomon/recognition/wall.hpp>

namespace {

namespace rec = gnomon::recognition;
using gnomon::degrees;
using gnomon::rigid_motion;

constexpr gnomon::constant_noise room_noise{room_views::sigma};

/// A chair and a table in a room, and what a sensor sees of them.
struct seen_room {
    std::vector<gnomon::simulation::furniture_model> models =
        gnomon::simulation::furniture_models();
    rigid_motion chair_pose = rigid_motion::on_ground(2.2, 0.6, degrees(140));
    rigid_motion table_pose = rigid_motion::on_ground(2.6, -0.9, degrees(20));
    gnomon::simulation::true_scan truth =
        room_views::scan_of({{models[0], chair_pose}, {models[10], table_pose}}, 1);
    rec::surface_model chair = room_views::surface_of(models[0]);
    rec::surface_model table = room_views::surface_of(models[10]);
    gnomon::spatial_index index{truth.scan};
    gnomon::visibility seen{truth.scan, {.noise = room_noise}};

    rec::verification verify(const rec::surface_model& model, const rigid_motion& pose) const {
        return rec::verify_pose(index, seen, model, pose, {.noise = room_noise});
    }
};

const seen_room& the_room() {
    static const seen_room room;
    return room;
}

TEST(verify_pose, supports_true_poses) {
    const auto& room = the_room();
    for (const auto& v :
         {room.verify(room.chair, room.chair_pose), room.verify(room.table, room.table_pose)}) {
        EXPECT_GT(v.support(), 0.97);
        EXPECT_GT(v.explanation(), 0.97);
        EXPECT_GT(v.containment(), 0.97);
        EXPECT_GT(v.observed(), 0.7);
        EXPECT_GT(v.points, 100u);
        EXPECT_EQ(v.facing, v.supported + v.seen_through + v.mismatched + v.in_walls + v.hidden +
                                v.unobserved);
        EXPECT_LE(v.facing, v.samples);
    }
}

/// Normals that are not finite are missing.
TEST(verify_pose, needs_no_normals) {
    const auto& room = the_room();
    for (const double missing : {0.0, clouds::nan}) {
        const std::vector<rec::surface_model::oriented> none(room.index.size(),
                                                             {Eigen::Vector3d::Constant(missing)});
        const auto v = rec::verify_pose(room.index, none, room.seen, room.chair, room.chair_pose,
                                        {.noise = room_noise});
        EXPECT_EQ(v.supported, room.verify(room.chair, room.chair_pose).supported);
    }
}

TEST(verify_pose, sees_through_objects_in_empty_space) {
    const auto& room = the_room();
    const auto v = room.verify(room.chair, rigid_motion::on_ground(1.3, -0.2, degrees(30)));
    EXPECT_LT(v.support(), 0.1);
    EXPECT_GT(v.seen_through, v.facing / 2);
}

TEST(verify_pose, rejects_wrong_models_and_poses) {
    const auto& room = the_room();
    EXPECT_LT(room.verify(room.table, room.chair_pose).support(), 0.6);
    EXPECT_LT(room.verify(room.chair, room.table_pose).support(), 0.6);
    // Turned, and a little aside.
    const auto turned = room.chair_pose * rigid_motion::on_ground(0, 0, degrees(90));
    EXPECT_LT(room.verify(room.chair, turned).support(), 0.7);
    const auto aside = room.chair_pose * rigid_motion::on_ground(0.10, 0.05, degrees(0));
    EXPECT_LT(room.verify(room.chair, aside).support(), 0.7);
    EXPECT_LT(room.verify(room.chair, aside).explanation(), 0.9);
}

/// An object that is a part of something larger explains what is within its bounds, but not what
/// goes on beyond them.
TEST(verify_pose, sees_surfaces_that_go_on) {
    const auto& room = the_room();
    const auto whole = room.verify(room.table, room.table_pose);
    std::vector<Eigen::Vector3d> inner;
    std::vector<rec::surface_model::oriented> normals;
    for (std::size_t i = 0; i < room.table.points().size(); ++i) {
        const Eigen::Vector3d p = room.table.points()[i];
        if (std::abs(p.x()) > 0.15 || std::abs(p.y()) > 0.15) continue;
        inner.push_back(p);
        normals.push_back(room.table.normals()[i]);
    }
    const rec::surface_model middle(inner, normals, room.table.spacing());
    const auto v = room.verify(middle, room.table_pose);
    EXPECT_GT(v.explanation(), 0.9);
    EXPECT_LT(v.containment(), 0.9);
    EXPECT_LT(v.containment(), whole.containment() - 0.07);
    EXPECT_LE(v.on_surface, v.near_surface);
    EXPECT_GE(v.near_surface, v.explained);
}

TEST(verify_pose, knows_hidden_places) {
    const auto& room = the_room();
    // Behind the wall opposite of the sensor.
    const auto v = room.verify(room.chair, rigid_motion::on_ground(9.0, 0.0, degrees(0)));
    EXPECT_EQ(v.supported + v.seen_through, 0u);
    EXPECT_GT(v.hidden, v.facing / 2);
    EXPECT_EQ(v.points, 0u);
    EXPECT_EQ(v.explanation(), 0.0);
}

/// A wall at x = 3 from y = -2 to y = `end`, seen from y = 0, and a table at some place. Rows
/// of points are `row` times as far apart as columns.
struct table_at_wall {
    static constexpr double at_wall = 3.0;  // [m]
    gnomon::scan scan;
    rec::wall wall;

    explicit table_at_wall(double end = 2.0, int row = 1) {
        for (double y = -2.0; y <= end; y += 0.01)
            for (double z = 0.0; z <= 2.0; z += 0.01 * row) scan.points.emplace_back(at_wall, y, z);
        scan.viewpoints = Eigen::Vector3d(0.0, 0.0, 1.2);
        wall = {{{-1.0, 0.0, 0.0}, -at_wall},
                {.center = {at_wall, 0.5 * (end - 2.0), 1.0}, .lengths = {0.0, end + 2.0, 2.0}}};
    }
    /// @param into  how deep it is in the wall [m]
    rec::verification verify(double into, double y = 0.0, bool is_known = true) const {
        const rec::surface_model& table = the_room().table;
        std::vector<rec::wall> walls;
        if (is_known) walls.push_back(wall);
        return rec::verify_pose(
            gnomon::spatial_index(scan), gnomon::visibility(scan, {.noise = room_noise}), table,
            rigid_motion::on_ground(at_wall - table.high().x() + into, y, degrees(0)),
            {.noise = room_noise, .walls = walls});
    }
};

/// A table that is pushed into a wall is hidden where it cannot be; one at the wall is not.
TEST(verify_pose, knows_what_stands_in_walls) {
    for (const int row : {1, 4}) {
        const table_at_wall room(2.0, row);
        const auto in = room.verify(0.3), unknown = room.verify(0.3, 0.0, false);
        EXPECT_EQ(room.verify(-0.01).in_walls, 0u);
        EXPECT_GT(in.in_walls, in.facing / 10) << row;
        EXPECT_EQ(in.hidden + in.in_walls, unknown.hidden);
        EXPECT_EQ(unknown.in_walls, 0u);
        EXPECT_EQ(in.facing, in.supported + in.seen_through + in.mismatched + in.in_walls +
                                 in.hidden + in.unobserved);
    }
}

/// An object in the next room does not stand in the wall, nor does one that crosses the plane of a
/// wall where this has ended.
TEST(verify_pose, knows_what_stands_next_to_walls) {
    const auto next_room = table_at_wall().verify(3.0);
    EXPECT_GT(next_room.hidden, next_room.facing / 2);
    EXPECT_EQ(next_room.in_walls, 0u);
    table_at_wall corner(-0.5);
    for (double y = -2.0; y <= 2.0; y += 0.01)  // a board in front hides where the wall is not
        for (double z = 0.0; z <= 1.0; z += 0.01) corner.scan.points.emplace_back(1.5, y, z);
    EXPECT_EQ(corner.verify(0.3, 0.3).in_walls, 0u);
    EXPECT_GT(corner.verify(0.3, -1.0).in_walls, 0u);
}

TEST(verify_pose, compares_normals) {
    const auto& room = the_room();
    struct with_normal {
        Eigen::Vector3d normal;
    };
    const auto verify = [&](const Eigen::Vector3d& normal) {
        const std::vector<with_normal> surface(room.index.size(), {normal});
        return rec::verify_pose(room.index, surface, room.seen, room.table, room.table_pose,
                                {.noise = room_noise});
    };
    const auto without = room.verify(room.table, room.table_pose);
    EXPECT_EQ(verify({0, 0, 0}).supported, without.supported);
    const auto upright = verify({0, 0, 1});
    EXPECT_LT(upright.supported, without.supported);
    EXPECT_GT(upright.supported, 0u);
    EXPECT_GT(upright.mismatched, without.mismatched);
}

TEST(verify_pose, handles_nothing) {
    const auto& room = the_room();
    const gnomon::spatial_index none;
    const gnomon::visibility blind(std::vector<Eigen::Vector3d>{});
    const auto v = rec::verify_pose(none, blind, room.chair, {});
    EXPECT_EQ(v.supported, 0u);
    EXPECT_EQ(v.support(), 0.0);
    const auto w = room.verify(rec::surface_model(), {});
    EXPECT_EQ(w.samples, 0u);
    EXPECT_EQ(w.observed(), 0.0);
}

TEST(verify_pose, refuses_what_cannot_be_meant) {
    const auto& room = the_room();
    const auto with = [&](const rec::verification_options& o) {
        return rec::verify_pose(room.index, room.seen, room.chair, {}, o);
    };
    EXPECT_THROW((void)with({.tolerance = 0.0}), std::invalid_argument);
    EXPECT_THROW((void)with({.tolerance = clouds::nan}), std::invalid_argument);
    EXPECT_THROW((void)with({.max_angle = degrees(91)}), std::invalid_argument);
    EXPECT_THROW((void)with({.lowest = clouds::nan}), std::invalid_argument);
    EXPECT_THROW((void)with({.around = -0.01}), std::invalid_argument);
    EXPECT_THROW((void)with({.around = clouds::nan}), std::invalid_argument);
    EXPECT_THROW((void)with({.walls = {{{{0.0, 0.0, 2.0}, 0.0}, {}}}}), std::invalid_argument);
    EXPECT_THROW((void)with({.walls = {{{}, {.lengths = {-1.0, 0.0, 0.0}}}}}),
                 std::invalid_argument);
    EXPECT_THROW((void)with({.most = 0}), std::invalid_argument);
    rigid_motion doubled;
    doubled.rotation *= 2.0;
    EXPECT_THROW((void)rec::verify_pose(room.index, room.seen, room.chair, doubled),
                 std::invalid_argument);
    EXPECT_THROW((void)rec::verify_pose(room.index, room.chair.normals(), room.seen, room.chair,
                                        rigid_motion{}),
                 std::invalid_argument);
}

}  // namespace
