// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/measure_noise.hpp>
#include <gnomon/simulation/depth_camera.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using gnomon::measure_noise;

const sim::scene room = sim::scenes::furnished_room({.pieces = 10, .seed = 20'101});

gnomon::scan range_finder(const sim::beam& beam,
                          const sim::scanner& finder = sim::densities::medium()) {
    return sim::simulate(room, sim::rotational{.mount = room.sensor}, finder, beam).scan;
}

/// The curve, or that of no noise and a failure of the test.
gnomon::noise_curve curve_of(const gnomon::measured_noise& measured) {
    EXPECT_TRUE(measured.curve.has_value()) << measured.reason;
    EXPECT_EQ(measured.reason.empty(), measured.curve.has_value());
    return measured.curve.value_or(gnomon::constant_noise{0.0});
}

TEST(measure_noise, finds_that_of_a_range_finder) {
    for (const double sigma : {0.005, 0.015, 0.030}) {
        const auto curve = curve_of(measure_noise(range_finder({.sigma = sigma, .seed = 3})));
        EXPECT_FALSE(curve.is_of_depth());
        for (const double range : {1.0, 2.0, 3.0, 4.0})
            EXPECT_NEAR(curve(range), sigma, 0.06 * sigma) << range;
    }
}

TEST(measure_noise, finds_how_it_grows_with_the_range) {
    const auto curve = curve_of(
        measure_noise(range_finder({.sigma = 0.003, .sigma_per_meter = 0.008, .seed = 4})));
    for (const double range : {1.0, 2.0, 3.0, 4.0}) {
        const double sigma = std::hypot(0.003, 0.008 * range);
        EXPECT_NEAR(curve(range), sigma, 0.08 * sigma) << range;
    }
}

TEST(measure_noise, of_a_scan_without_any_is_next_to_nothing) {
    EXPECT_LT(curve_of(measure_noise(range_finder({})))(3.0), 1e-5);
}

/// The noise of a camera goes with the depth along its axis.
TEST(measure_noise, finds_that_of_a_depth_camera) {
    sim::depth_camera camera{.columns = 320, .rows = 240, .focal_length = 288.0};
    camera.noise = gnomon::quadratic_noise{0.0, 0.0, 0.003};
    const gnomon::noise_curve truth{gnomon::quadratic_noise{0.0, 0.0, 0.003},
                                    room.sensor.direction_out({1.0, 0.0, 0.0})};
    const gnomon::scan image = sim::simulate(room, room.sensor, camera).scan;
    const auto curve = curve_of(measure_noise(image));
    double sum = 0.0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        const Eigen::Vector3d ray = image.points[i] - image.viewpoints[i];
        ASSERT_NEAR(curve.along(ray), truth.along(ray), 0.25 * truth.along(ray));
        sum += std::abs(curve.along(ray) / truth.along(ray) - 1.0);
    }
    EXPECT_LT(sum / static_cast<double>(image.size()), 0.1);
}

/// Where steps are longer than the noise, it is step / sqrt(12).
TEST(measure_noise, finds_the_steps_of_a_quantized_camera) {
    sim::depth_camera camera{.focal_length = 575.0, .baseline = 0.075, .disparity_step = 0.125};
    for (const double c : {0.0, 0.0003}) {
        camera.noise = gnomon::quadratic_noise{0.0, 0.0, c};
        const auto curve = curve_of(measure_noise(sim::simulate(room, room.sensor, camera).scan));
        ASSERT_TRUE(curve.is_of_depth()) << c;
        const Eigen::Vector3d axis = room.sensor.direction_out({1.0, 0.0, 0.0});
        EXPECT_GT(std::abs(curve.axis().dot(axis)), std::cos(degrees(0.2).radians()));
        for (const double z : {2.0, 3.0, 4.0}) {
            const double step = 0.125 * z * z / (575.0 * 0.075);
            EXPECT_NEAR(curve.step(z), step, 0.1 * step) << z;
            EXPECT_GE(curve(z), 0.9 * step / std::sqrt(12.0)) << z;
            EXPECT_LE(curve(z), 1.2 * std::hypot(c * z * z, step / std::sqrt(12.0))) << z;
        }
    }
}

TEST(measure_noise, of_a_moving_sensor_is_that_of_its_view_points) {
    const auto driven = sim::along(4.0, [](double seconds) {
        sim::pose pose = room.sensor;
        pose.position += Eigen::Vector3d(0.1 * seconds, 0.05 * seconds, 0.0);
        return pose * sim::pitch(degrees(30.0 * seconds - 60.0));
    });
    const auto seen =
        sim::simulate(room, driven, sim::densities::medium(), {.sigma = 0.01, .seed = 5});
    const auto curve = curve_of(measure_noise(seen.scan));
    for (const double range : {1.0, 2.0, 3.0}) EXPECT_NEAR(curve(range), 0.01, 0.001) << range;
}

/// Two scans of a room, moved into one frame, whose file knows no view point.
TEST(measure_noise, notices_a_view_point_that_is_none) {
    gnomon::scan fused;
    for (const double x : {-1.2, 1.2}) {
        sim::pose mount = room.sensor;
        mount.position.x() += x;
        mount.position.y() += 0.5 * x;
        const auto seen = sim::simulate(room, sim::rotational{.mount = mount},
                                        sim::densities::medium(), {.sigma = 0.01, .seed = 6});
        const auto& p = seen.scan.points;
        fused.points.insert(fused.points.end(), p.begin(), p.end());
    }
    for (Eigen::Vector3d& p : fused.points) p -= Eigen::Vector3d(20.0, 20.0, 0.0);  // far outside
    const auto measured = measure_noise(fused);
    EXPECT_FALSE(measured.curve.has_value());
    EXPECT_NE(measured.reason.find("view point"), std::string_view::npos) << measured.reason;
}

/// World coordinates without a view point: the origin, which is taken for it, is far away.
TEST(measure_noise, notices_an_origin_that_is_far_away) {
    gnomon::scan scan = range_finder({.sigma = 0.01, .seed = 6});
    for (Eigen::Vector3d& p : scan.points) p += Eigen::Vector3d(6e5, 4.8e6, 100.0);
    scan.viewpoints = {};
    const auto measured = measure_noise(scan);
    EXPECT_FALSE(measured.curve.has_value());
    EXPECT_NE(measured.reason.find("view point"), std::string_view::npos) << measured.reason;
}

TEST(measure_noise, gives_a_reason_where_there_are_no_planes) {
    gnomon::random_stream random(7);
    gnomon::scan leaves;
    for (int i = 0; i < 20'000; ++i) {
        leaves.points.push_back(Eigen::Vector3d(3.0, 0.0, 0.0) + clouds::gaussian_vector(random));
    }
    const auto measured = measure_noise(leaves);
    EXPECT_FALSE(measured.curve.has_value());
    EXPECT_FALSE(measured.reason.empty());
    const auto of_few = measure_noise(clouds::cloud(100, Eigen::Vector3d(1, 2, 3)));
    EXPECT_FALSE(of_few.curve.has_value());
    EXPECT_FALSE(of_few.reason.empty());
    EXPECT_FALSE(measure_noise(clouds::cloud{}).curve.has_value());
    EXPECT_FALSE(measure_noise(clouds::cloud(1000, Eigen::Vector3d(1, 2, 3))).curve.has_value());
}

/// Whatever the cloud is: a curve that is a standard deviation, or a reason.
TEST(measure_noise, has_an_answer_for_every_cloud) {
    auto all = clouds::degenerate();
    for (const double scale : {1e-9, 1e6, 1e100, 1e300}) {
        clouds::cloud points = clouds::sheet(3000, 9);
        for (Eigen::Vector3d& p : points) p *= scale;
        all.push_back({"scaled by " + std::to_string(scale), points});
    }
    clouds::cloud doubled = clouds::sheet(2000, 10);
    doubled.insert(doubled.end(), doubled.begin(), doubled.end());
    all.push_back({"all points twice", doubled});
    all.push_back({"on a line", clouds::cloud()});
    for (int i = 0; i < 2000; ++i) all.back().points.emplace_back(0.01 * i, 1.0, 0.5);
    for (const auto& [name, points] : all) {
        SCOPED_TRACE(name);
        for (const Eigen::Vector3d& viewpoint :
             {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.3, 0.2, 5.0),
              Eigen::Vector3d(clouds::nan, 0, 0), Eigen::Vector3d(clouds::infinity, 0, 0)}) {
            const auto measured = measure_noise(gnomon::with_viewpoint(points, viewpoint));
            ASSERT_NE(measured.curve.has_value(), !measured.reason.empty());
            if (!measured.curve) continue;
            for (const double x : {0.1, 1.0, 100.0}) ASSERT_GT((*measured.curve)(x), 0.0);
        }
    }
}

TEST(measure_noise, is_the_same_for_an_index_for_every_execution_and_elsewhere) {
    const gnomon::scan scan = range_finder({.sigma = 0.015, .seed = 8}, sim::densities::low());
    const auto one = curve_of(measure_noise(scan));
    const auto two = curve_of(measure_noise(gnomon::spatial_index(scan), gnomon::threads{3}));
    for (const double x : {0.5, 2.0, 5.0}) EXPECT_EQ(one(x), two(x));

    gnomon::scan moved = scan;  // to UTM coordinates
    const Eigen::Vector3d far(6e5, 4.8e6, 100.0);
    for (Eigen::Vector3d& p : moved.points) p += far;
    moved.viewpoints = Eigen::Vector3d(scan.viewpoints[0] + far);
    // Rounding decides which of equally near rays are neighbors.
    EXPECT_NEAR(curve_of(measure_noise(moved))(2.0), one(2.0), 1e-3 * one(2.0));

    gnomon::scan holed = scan;
    holed.points.insert(holed.points.begin() + 100, Eigen::Vector3d(clouds::nan, 0.0, 0.0));
    EXPECT_NEAR(curve_of(measure_noise(holed))(2.0), one(2.0), 0.05 * one(2.0));
}

}  // namespace
