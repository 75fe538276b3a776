// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/spinning_lidar.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using sim::spinning_lidar;
static_assert(sim::detail::line_scanner<spinning_lidar>);
static_assert(sim::detail::line_scanner<sim::scanner>);
static_assert(!sim::detail::line_scanner<sim::depth_camera>);

const std::vector<spinning_lidar> velodynes{sim::scanners::velodyne_vlp_16(),
                                            sim::scanners::velodyne_hdl_32e(),
                                            sim::scanners::velodyne_hdl_64e()};

sim::scene closed_room() {
    sim::scene world;
    world.add_object("room", sim::box{9, 7, 5}, sim::at(0, 0, 1));
    return world;
}

/// One revolution from a pose.
sim::fixed standing(const spinning_lidar& lidar, const sim::pose& mount = {}) {
    return {.mount = mount, .duration = lidar.revolution()};
}

/// A lidar of random elevations.
spinning_lidar any_lidar(gnomon::random_stream& random) {
    spinning_lidar lidar{.elevations = {}, .columns = 1 + random.below(400)};
    const auto beams = 1 + random.below(20);
    for (std::uint64_t j = 0; j < beams; ++j)
        lidar.elevations.push_back(degrees(random.uniform(-60.0, 60.0)));
    lidar.frequency = random.uniform(1.0, 30.0);
    lidar.min_range = 0.0;
    return lidar;
}

/// The tables of the user manuals.
TEST(spinning_lidar, has_the_published_elevations) {
    const auto& vlp_16 = velodynes[0].elevations;
    ASSERT_EQ(vlp_16.size(), 16u);
    for (std::size_t j = 0; j < 16; ++j)
        EXPECT_NEAR(vlp_16[j].degrees(), 15.0 - 2.0 * static_cast<double>(j), 1e-12);

    const auto& hdl_32e = velodynes[1].elevations;
    ASSERT_EQ(hdl_32e.size(), 32u);
    const std::vector<double> some{10.67, 9.33, 8.0, 6.67, 5.33, 4.0, 2.67, 1.33, 0.0, -1.33};
    for (std::size_t j = 0; j < some.size(); ++j) EXPECT_NEAR(hdl_32e[j].degrees(), some[j], 0.005);
    EXPECT_NEAR(hdl_32e.back().degrees(), -30.67, 0.005);

    const auto& hdl_64e = velodynes[2].elevations;
    ASSERT_EQ(hdl_64e.size(), 64u);
    EXPECT_NEAR(hdl_64e[0].degrees(), 2.0, 1e-12);
    EXPECT_NEAR(hdl_64e[31].degrees(), -8.333, 0.001);
    EXPECT_NEAR(hdl_64e[32].degrees(), -8.833, 0.001);
    EXPECT_NEAR(hdl_64e[63].degrees(), -24.333, 0.001);
}

/// The times between columns, and points per second, of the user manuals.
TEST(spinning_lidar, has_the_published_rates) {
    EXPECT_NEAR(velodynes[0].line_rate() * 55.296e-6, 1.0, 1e-3);
    EXPECT_NEAR(velodynes[1].line_rate() * 46.08e-6, 1.0, 1e-3);
    EXPECT_NEAR(velodynes[2].line_rate() * 64.0, 1.333e6, 1e3);
    for (const spinning_lidar& lidar : velodynes) {
        EXPECT_NO_THROW(lidar.require_valid());
        EXPECT_EQ(lidar.lines(lidar.revolution()), lidar.columns);
        EXPECT_EQ(lidar.lines(10.0 * lidar.revolution()), 10 * lidar.columns);
    }
}

/// A law of every instrument that measures lines: lines turn without moving, and directions have
/// unit length.
TEST(spinning_lidar, turns_unit_directions_without_moving_them) {
    gnomon::random_stream random(20'001);
    for (int trial = 0; trial < 50; ++trial) {
        const spinning_lidar lidar = any_lidar(random);
        for (std::size_t j = 0; j < lidar.beams(); ++j)
            EXPECT_NEAR(lidar.direction(j).norm(), 1.0, 1e-15);
        for (std::size_t line = 0; line < 2 * lidar.columns; ++line) {
            EXPECT_TRUE(gnomon::is_rigid(lidar.line_pose(line)));
            EXPECT_EQ(lidar.line_pose(line).position, Eigen::Vector3d(0, 0, 0));
        }
    }
}

/// Column by column, from behind over the left, the front and the right, equally spaced, and the
/// same in each revolution.
TEST(spinning_lidar, turns_clockwise_from_behind) {
    gnomon::random_stream random(20'002);
    for (int trial = 0; trial < 20; ++trial) {
        const spinning_lidar lidar = any_lidar(random);
        const auto truth =
            sim::simulate(closed_room(), sim::fixed{.duration = 2.0 * lidar.revolution()}, lidar);
        const std::size_t sweep = lidar.columns * lidar.beams();
        ASSERT_EQ(truth.scan.size(), 2 * sweep);
        for (std::size_t i = 0; i < 2 * sweep; ++i) {
            const Eigen::Vector3d& u = truth.directions[i];
            EXPECT_NEAR(std::asin(u.z()), lidar.elevations[i % lidar.beams()].radians(), 1e-12);
            const double share = (static_cast<double>((i % sweep) / lidar.beams()) + 0.5) /
                                 static_cast<double>(lidar.columns);
            EXPECT_NEAR(std::atan2(u.y(), u.x()), std::numbers::pi * (1.0 - 2.0 * share), 1e-12);
        }
    }
}

/// On level ground a beam of elevation -e draws a circle of radius h / tan(e).
TEST(spinning_lidar, draws_circles_on_the_ground) {
    sim::scene world;
    world.add_object("ground", sim::plane_patch{500, 500});
    constexpr double height = 1.8;
    for (const spinning_lidar& lidar : velodynes) {
        const auto truth = sim::simulate(world, standing(lidar, sim::at(3, -2, height)), lidar);
        std::size_t expected = 0;
        for (const gnomon::angle e : lidar.elevations) {
            const double range = -height / sin(e);
            if (range > lidar.min_range && range <= lidar.max_range) expected += lidar.columns;
        }
        ASSERT_EQ(truth.scan.size(), expected);
        ASSERT_GT(expected, 5 * lidar.columns);
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            const Eigen::Vector3d p = truth.scan.points[i];
            const double radius =
                height * std::sqrt(1.0 / std::pow(truth.directions[i].z(), 2) - 1);
            EXPECT_NEAR(std::hypot(p.x() - 3, p.y() + 2), radius, 1e-9 * radius);
            EXPECT_NEAR(p.z(), 0.0, 1e-9);
        }
    }
}

/// A sensor at rest has one view point; one that moves has one per column, on its path.
TEST(spinning_lidar, has_a_view_point_per_column_while_it_moves) {
    const auto lidar = sim::scanners::velodyne_vlp_16();
    const auto room = closed_room();
    const auto still = sim::simulate(room, standing(lidar, sim::at(0.5, 0, 1)), lidar);
    EXPECT_EQ(still.scan.viewpoints.positions().size(), 1u);
    EXPECT_EQ(still.scan.size(), lidar.columns * 16);

    const sim::driving drive{.mount = sim::at(0.5, 0, 1)};
    const auto moved = sim::simulate(room, drive, lidar);
    ASSERT_EQ(moved.scan.size(), lidar.columns * 16);
    EXPECT_EQ(moved.scan.viewpoints.positions().size(), lidar.columns);
    for (std::size_t i = 0; i < moved.scan.size(); ++i) {
        const double seconds = (static_cast<double>(i / 16) + 0.5) / lidar.line_rate();
        const Eigen::Vector3d v = moved.scan.viewpoints[i];
        EXPECT_LT((v - Eigen::Vector3d(0.5 + 15.0 * seconds, 0, 1)).norm(), 1e-12);
        const Eigen::Vector3d p = v + moved.ranges[i] * moved.directions[i];
        EXPECT_LT((moved.scan.points[i] - p).norm(), 1e-12);
    }
}

TEST(spinning_lidar, is_the_same_for_every_execution) {
    const auto lidar = sim::scanners::velodyne_hdl_32e();
    const sim::driving drive{.mount = sim::at(0.5, 0, 1), .duration = lidar.revolution()};
    const sim::beam b{.sigma = 0.02, .clutter = 0.01, .failure = 0.05, .seed = 20'003};
    const auto one = sim::simulate(closed_room(), drive, lidar, b);
    ASSERT_LT(one.scan.size(), lidar.columns * 32);
    for (const unsigned n : {1u, 3u}) {
        const auto other = sim::simulate(closed_room(), drive, lidar, b, gnomon::threads{n});
        ASSERT_EQ(other.scan.size(), one.scan.size());
        EXPECT_EQ(std::memcmp(other.scan.points.data(), one.scan.points.data(),
                              one.scan.size() * sizeof(one.scan.points[0])),
                  0);
        for (std::size_t i = 0; i < one.scan.size(); ++i)
            ASSERT_EQ(other.scan.viewpoints[i], one.scan.viewpoints[i]);
    }
}

TEST(spinning_lidar, rejects_invalid_parameters) {
    for (const spinning_lidar& bad :
         {spinning_lidar{.elevations = {}}, spinning_lidar{.elevations = {degrees(90)}},
          spinning_lidar{.elevations = {degrees(0), degrees(-91)}},
          spinning_lidar{.elevations = {degrees(clouds::nan)}},
          spinning_lidar{.elevations = std::vector<gnomon::angle>(10'001)},
          spinning_lidar{.columns = 0}, spinning_lidar{.columns = 10'000'001},
          spinning_lidar{.frequency = 0}, spinning_lidar{.frequency = clouds::infinity},
          spinning_lidar{.min_range = -1}, spinning_lidar{.min_range = 100},
          spinning_lidar{.max_range = clouds::infinity},
          spinning_lidar{.max_range = clouds::nan}}) {
        EXPECT_THROW(bad.require_valid(), std::invalid_argument);
        EXPECT_THROW((void)sim::simulate(closed_room(), sim::fixed{}, bad), std::invalid_argument);
    }
    EXPECT_THROW((void)sim::simulate(closed_room(), sim::fixed{.duration = -1}, spinning_lidar{}),
                 std::invalid_argument);
    EXPECT_THROW((void)sim::simulate(closed_room(), sim::fixed{.duration = 1e6}, spinning_lidar{}),
                 std::invalid_argument);
}

}  // namespace
