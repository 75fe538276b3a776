// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/execution.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/depth_camera.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;

/// A wall across the optical axis.
sim::scene wall_at(double depth) {
    sim::scene world;
    world.add_object("wall", sim::plane_patch{100, 100},
                     sim::at(depth, 0, 0) * sim::pitch(degrees(-90)));
    return world;
}

/// The depths of the points along x.
std::vector<double> depths_of(const sim::true_scan& image) {
    std::vector<double> depths;
    for (const Eigen::Vector3d& p : image.scan.points) depths.push_back(p.x());
    return depths;
}

TEST(depth_camera, has_a_pixel_in_each_direction) {
    const sim::depth_camera camera{.columns = 5, .rows = 3, .focal_length = 2.0};
    ASSERT_EQ(camera.pixels(), 15u);
    EXPECT_EQ(camera.direction(7), Eigen::Vector3d(1, 0, 0));                     // the middle
    EXPECT_GT(camera.direction(0).y(), 0.0);                                      // left
    EXPECT_GT(camera.direction(0).z(), 0.0);                                      // and up
    EXPECT_NEAR(camera.direction(8).y() / camera.direction(8).x(), -0.5, 1e-15);  // 1 / f
    for (std::size_t i = 0; i < camera.pixels(); ++i)
        EXPECT_NEAR(camera.direction(i).norm(), 1.0, 1e-15);
}

TEST(depth_camera, returns_the_truth_about_each_pixel) {
    const sim::pose sensor = sim::at(1, 2, 3) * sim::yaw(degrees(40));
    sim::scene world;
    world.add_object("floor", sim::plane_patch{100, 100});
    const auto image = sim::simulate(
        world, sensor * sim::pitch(degrees(30)),
        sim::depth_camera{.columns = 64, .rows = 48, .focal_length = 60.0, .max_depth = 50.0});
    ASSERT_GT(image.scan.size(), 2000u);
    for (std::size_t i = 0; i < image.scan.size(); ++i) {
        EXPECT_NEAR(image.scan.points[i].z(), 0.0, 1e-12);
        EXPECT_EQ(image.scan.viewpoints[i], sensor.position);
        EXPECT_EQ(image.surfaces[i], 0);
        EXPECT_NEAR((image.scan.points[i] - sensor.position).norm(), image.ranges[i], 1e-12);
    }
}

/// The error is one of the depth, also at the corners of the image.
TEST(depth_camera, errs_by_the_noise_of_the_depth) {
    sim::depth_camera camera{.columns = 200, .rows = 200, .focal_length = 120.0};
    camera.noise = gnomon::quadratic_noise{0.001, 0.0, 0.002};
    const auto image = sim::simulate(wall_at(3.0), sim::pose{}, camera);
    ASSERT_EQ(image.scan.size(), 40'000u);
    double near_axis = 0.0, far = 0.0;
    std::size_t of_near = 0;
    for (const Eigen::Vector3d& p : image.scan.points) {
        const double e = (p.x() - 3.0) * (p.x() - 3.0);
        const bool is_near = std::hypot(p.y(), p.z()) < 1.0;
        (is_near ? near_axis : far) += e;
        of_near += is_near;
    }
    const double sigma = 0.001 + 0.002 * 9.0;
    EXPECT_NEAR(std::sqrt(near_axis / static_cast<double>(of_near)), sigma, 0.05 * sigma);
    EXPECT_NEAR(std::sqrt(far / static_cast<double>(40'000 - of_near)), sigma, 0.05 * sigma);
}

/// Steps of the disparity are steps of the depth, by z^2 / (f b) of them.
TEST(depth_camera, reports_depths_in_steps) {
    sim::depth_camera camera{
        .columns = 320, .rows = 240, .baseline = 0.075, .disparity_step = 0.125};
    camera.noise = gnomon::constant_noise{0.03};
    for (const double z : {1.0, 2.0, 4.0}) {
        auto depths = depths_of(sim::simulate(wall_at(z), sim::pose{}, camera));
        std::set<double> distinct;
        for (const double d : depths) distinct.insert(std::round(1e9 * d) / 1e9);
        ASSERT_GT(distinct.size(), 2u);
        std::vector<double> sorted(distinct.begin(), distinct.end());
        const double step = 0.125 * z * z / (575.0 * 0.075);
        const auto above = std::lower_bound(sorted.begin() + 1, sorted.end() - 1, z);
        EXPECT_NEAR(*above - *(above - 1), step, 0.1 * step) << z;
    }
}

TEST(depth_camera, sees_only_its_depths) {
    const sim::depth_camera camera{.columns = 40, .rows = 30, .min_depth = 1.0, .max_depth = 2.0};
    EXPECT_EQ(sim::simulate(wall_at(0.9), sim::pose{}, camera).scan.size(), 0u);
    EXPECT_EQ(sim::simulate(wall_at(1.1), sim::pose{}, camera).scan.size(), 1200u);
    EXPECT_EQ(sim::simulate(wall_at(1.99), sim::pose{}, camera).scan.size(), 1200u);  // corners too
    EXPECT_EQ(sim::simulate(wall_at(2.1), sim::pose{}, camera).scan.size(), 0u);
}

/// A pixel that sees two surfaces reports a depth between them.
TEST(depth_camera, skims_edges_where_pixels_have_a_width) {
    sim::scene world = wall_at(3.0);
    world.add_object("box", sim::box{0.5, 0.5, 0.5}, sim::at(2.0, 0.0, -0.25));
    const sim::depth_camera camera{.columns = 160, .rows = 120, .focal_length = 140.0};
    const auto sharp = sim::simulate(world, sim::pose{}, camera);
    const auto wide = sim::simulate(world, sim::pose{}, camera, {.footprint = camera.pixel()});
    const auto mixed = [](const sim::true_scan& image) {
        return std::count(image.echoes.begin(), image.echoes.end(), sim::echo::mixed);
    };
    EXPECT_EQ(mixed(sharp), 0);
    EXPECT_GT(mixed(wide), 50);
    EXPECT_LT(mixed(wide), 1000);
}

TEST(depth_camera, is_the_same_for_every_execution) {
    const auto camera = sim::scanners::structured_light();
    const auto world = wall_at(2.0);
    const auto one = sim::simulate(world, sim::pose{}, camera);
    const auto two = sim::simulate(world, sim::pose{}, camera, {}, gnomon::threads{3});
    ASSERT_EQ(one.scan.size(), two.scan.size());
    for (std::size_t i = 0; i < one.scan.size(); ++i)
        ASSERT_EQ(one.scan.points[i], two.scan.points[i]);
}

TEST(depth_camera, of_the_literature_are_valid) {
    for (const sim::depth_camera& camera :
         {sim::scanners::structured_light(), sim::scanners::time_of_flight(),
          sim::scanners::stereo()}) {
        EXPECT_NO_THROW(camera.require_valid());
        EXPECT_GT(sim::simulate(wall_at(2.0), sim::pose{}, camera).scan.size(),
                  camera.pixels() / 2);
    }
}

TEST(depth_camera, refuses_what_is_no_camera) {
    const auto world = wall_at(2.0);
    const auto refused = [&](const sim::depth_camera& camera, const sim::pose& sensor = {}) {
        EXPECT_THROW((void)sim::simulate(world, sensor, camera), std::invalid_argument);
    };
    refused({.columns = 0});
    refused({.rows = 0});
    refused({.columns = 1'000'000'000, .rows = 1'000'000'000});
    refused({.focal_length = 0.0});
    refused({.focal_length = std::nan("")});
    refused({.baseline = -1.0});
    refused({.disparity_step = 0.125});  // without a baseline
    refused({.min_depth = 2.0, .max_depth = 1.0});
    refused({.max_depth = std::nan("")});
    sim::pose sheared;
    sheared.rotation(0, 1) = 0.5;
    refused({}, sheared);
}

}  // namespace
