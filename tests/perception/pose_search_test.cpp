// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/pose_search.hpp>
#include <gnomon/recognition/wall.hpp>
#include <gnomon/simulation.hpp>
#include <gnomon/simulation/sample_surface.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using gnomon::rigid_motion;

rec::surface_model surface_of(const sim::furniture_model& model) {
    const auto samples = sim::sample_surface(model, {.spacing = 0.02});
    return rec::surface_model(samples, samples, 0.02, std::nullopt, &sim::surface_sample::position);
}

/// Models at poses on a floor, the cells above it, and what the sensor saw.
struct seen_models {
    std::vector<rec::detail::ground_cell> cells;
    gnomon::visibility seen;
    rigid_motion frame;

    seen_models(const std::vector<sim::furniture_model>& models,
                const std::vector<rigid_motion>& poses, const rigid_motion& motion = {})
        : seen(std::vector<Eigen::Vector3d>{}), frame(motion) {
        sim::scene world;
        world.add_object("floor", sim::plane_patch{.length = 6.0, .width = 6.0},
                         sim::at(2.5, 0.0, 0.0));
        for (std::size_t i = 0; i < models.size(); ++i) sim::add(world, models[i], poses[i]);
        auto truth =
            sim::simulate(world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0},
                          sim::scanner{}, {.sigma = 0.005, .seed = 5});
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            Eigen::Vector3d& p = truth.scan.points[i];
            if (truth.objects[i] > 0 && p.z() > 0.05)
                cells.push_back({p, std::abs(truth.normals[i].z())});
            p = motion.point_out(p);
        }
        truth.scan.viewpoints = motion.point_out({0.0, 0.0, 1.2});
        seen = gnomon::visibility(truth.scan, {.noise = gnomon::constant_noise{0.005}});
    }
};

/// The rank of the first place of an object that is close to a pose; the number of places if none.
std::size_t rank_of(const std::vector<rec::object_place>& places, std::size_t object,
                    const rigid_motion& pose, const rec::surface_model& model) {
    std::size_t rank = 0;
    for (const rec::object_place& p : places) {
        if (p.object != object) continue;
        const Eigen::Vector3d ahead = pose.direction_in(p.pose.direction_out({1, 0, 0}));
        const auto turn = gnomon::radians(std::atan2(ahead.y(), ahead.x()));
        if ((p.pose.position - pose.position).norm() < 0.15 &&
            model.symmetry().difference(turn, degrees(0.0)) < degrees(20.0))
            break;
        ++rank;
    }
    return rank;
}

/// In any frame of the scan, on any number of threads.
TEST(pose_search, finds_objects_by_their_surfaces_alone) {
    const auto all = sim::furniture_models();
    const std::vector models{all[0], all[10]};
    const std::vector poses{rigid_motion::on_ground(2.0, 0.8, degrees(160)),
                            rigid_motion::on_ground(2.3, -0.7, degrees(10))};
    std::vector<rec::surface_model> surfaces;
    for (const auto& m : models) surfaces.push_back(surface_of(m));
    rigid_motion moved;
    moved.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 1, 3).normalized()).matrix();
    moved.position = {4e5, 5e6, 300.0};
    for (const rigid_motion& motion : {rigid_motion{}, moved}) {
        const seen_models scene(models, poses, motion);
        const auto places = rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {},
                                                      surfaces, gnomon::sequential{});
        for (std::size_t o = 0; o < models.size(); ++o)
            EXPECT_LT(rank_of(places, o, motion * poses[o], surfaces[o]), 2u) << models[o].name;
        const auto again = rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {},
                                                     surfaces, gnomon::threads{3});
        ASSERT_EQ(again.size(), places.size());
        for (std::size_t i = 0; i < places.size(); ++i) {
            EXPECT_EQ(again[i].object, places[i].object);
            EXPECT_EQ(again[i].pose.position, places[i].pose.position);
        }
    }
}

/// Where the sensor saw through, there is nothing.
TEST(pose_search, finds_no_table_where_a_chair_stands_alone) {
    const auto all = sim::furniture_models();
    const seen_models scene({all[0]}, {rigid_motion::on_ground(2.0, 0.0, degrees(160))});
    const auto desk = std::ranges::find(all, "desk", &sim::furniture_model::name);
    const std::vector surfaces{surface_of(*desk)};
    EXPECT_TRUE(rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {}, surfaces,
                                          gnomon::sequential{})
                    .empty());
}

/// Pieces of the ground are searched one by one, and borders between them hide nothing.
TEST(pose_search, finds_objects_far_from_each_other) {
    const auto all = sim::furniture_models();
    const std::vector poses{rigid_motion::on_ground(2.0, 0.8, degrees(160))};
    const seen_models scene({all[0]}, poses);
    std::vector<rec::detail::ground_cell> cells = scene.cells;
    const std::vector surfaces{surface_of(all[0])};
    for (const double x : {-6.1, -6.4, -14.0, -3000.0}) {
        cells = scene.cells;
        cells.push_back({{x, -0.5, 0.4}, 1.0});
        const auto places = rec::detail::search_poses(cells, scene.frame, scene.seen, {}, surfaces,
                                                      gnomon::sequential{});
        EXPECT_LT(rank_of(places, 0, poses[0], surfaces[0]), 4u) << x;
    }
}

/// As a mesh in millimetres is.
TEST(pose_search, leaves_out_what_is_larger_than_a_room) {
    const auto all = sim::furniture_models();
    const seen_models scene({all[0]}, {rigid_motion::on_ground(2.0, 0.8, degrees(160))});
    const auto chair = surface_of(all[0]);
    std::vector<Eigen::Vector3d> huge;
    for (const Eigen::Vector3d& p : chair.points()) huge.push_back(1000.0 * p);
    const std::vector surfaces{rec::surface_model(huge, chair.normals(), 20.0), chair};
    const auto places = rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {},
                                                  surfaces, gnomon::sequential{});
    EXPECT_FALSE(places.empty());
    EXPECT_TRUE(std::ranges::all_of(places, [](const auto& p) { return p.object == 1; }));
}

/// All of a mat is in the band of the floor, which has no cells.
TEST(pose_search, finds_no_mats) {
    const auto all = sim::furniture_models();
    const seen_models scene({all[0]}, {rigid_motion::on_ground(2.0, 0.8, degrees(160))});
    std::vector<Eigen::Vector3d> mat;
    std::vector<rec::surface_model::oriented> normals;
    for (int i = 0; i < 20; ++i) {
        for (int j = 0; j < 20; ++j) {
            mat.emplace_back(0.02 * i - 0.2, 0.02 * j - 0.2, 0.01);
            normals.push_back({{0.0, 0.0, 1.0}});
        }
    }
    const std::vector surfaces{rec::surface_model(mat, normals, 0.02)};
    EXPECT_TRUE(rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {}, surfaces,
                                          gnomon::sequential{})
                    .empty());
}

/// Little behind a wall is nothing, but farther behind it may be another room.
TEST(pose_search, finds_nothing_in_walls) {
    constexpr double at_wall = 3.0, edge = rec::detail::observed_space::edge;  // [m]
    gnomon::scan scan;
    for (double y = -3.0; y <= 3.0; y += 0.01)
        for (double z = 0.0; z <= 2.4; z += 0.01) scan.points.emplace_back(at_wall, y, z);
    scan.viewpoints = Eigen::Vector3d(0.0, 0.0, 1.2);
    const gnomon::visibility seen(scan,
                                  {.pixel = degrees(0.3), .noise = gnomon::constant_noise{0.005}});
    const std::vector<rec::detail::ground_cell> cells{{{2.8, 0.0, 0.7}}, {{2.8, 1.0, 0.7}}};
    const rec::wall half{{{-1.0, 0.0, 0.0}, -at_wall},
                         {.center = {at_wall, -1.5, 1.2}, .lengths = {0.0, 3.0, 2.4}}};
    const auto value = [&](const std::vector<rec::wall>& walls, double x, double y) {
        const rec::detail::observed_space space(cells, rigid_motion{}, seen, walls, 1.5, 1.0,
                                                gnomon::sequential{});
        const auto column = [&](std::size_t axis, double at) {
            return static_cast<std::size_t>(std::lround((at - space.middle(axis, 0)) / edge));
        };
        return space.column(column(0, x), column(1, y))[14];  // 0.7 m above ground
    };
    constexpr auto empty = rec::detail::observed_space::empty;
    EXPECT_EQ(value({half}, 2.6, -0.5), empty);  // seen through
    EXPECT_EQ(value({half}, 3.15, -0.5), empty);
    EXPECT_EQ(value({}, 3.15, -0.5), 0);
    EXPECT_EQ(value({half}, 3.15, 0.5), 0);
    EXPECT_EQ(value({half}, 3.5, -0.5), 0);
}

TEST(pose_search, of_no_objects_finds_none) {
    const auto all = sim::furniture_models();
    const seen_models scene({all[0]}, {rigid_motion::on_ground(2.0, 0.8, degrees(160))});
    EXPECT_TRUE(rec::detail::search_poses(scene.cells, scene.frame, scene.seen, {}, {},
                                          gnomon::sequential{})
                    .empty());
}

}  // namespace
