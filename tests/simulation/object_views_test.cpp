// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numbers>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/sphere.hpp>

namespace sim = gnomon::simulation;

namespace {

const std::vector<sim::furniture_model> pieces = sim::furniture_models();

/// Options whose scans cost nothing, where only poses matter.
sim::object_view_options poses_only(std::uint64_t seed = 1) {
    return {.scanner = {.resolution = gnomon::degrees(60), .frequency = 1.0},
            .duration = 1.0,
            .seed = seed};
}

/// Of a quarter of the rays.
sim::object_view_options coarse(double share = 0.0) {
    return {.scanner = {.resolution = gnomon::degrees(0.5)},
            .duration = 4.0,
            .occluded_share = share,
            .seed = 5};
}

template <class T>
bool equal_bytes(const std::vector<T>& a, const std::vector<T>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

bool equal_views(const sim::object_view& a, const sim::object_view& b) {
    return equal_bytes(a.truth.scan.points, b.truth.scan.points) &&
           equal_bytes(a.truth.objects, b.truth.objects) &&
           equal_bytes(a.truth.parts, b.truth.parts) &&
           equal_bytes(a.truth.ranges, b.truth.ranges) && a.pose.position == b.pose.position &&
           a.pose.rotation == b.pose.rotation;
}

double yaw_of(const sim::object_view& view) {
    return std::atan2(view.pose.rotation(1, 0), view.pose.rotation(0, 0));
}

TEST(object_views, do_not_depend_on_order_or_threads) {
    const std::vector<sim::furniture_model> models{pieces[0], pieces[8]};
    for (const double share : {0.0, 0.4}) {
        const auto options = coarse(share);
        const auto views = sim::simulate_object_views(models, 3, options);
        ASSERT_EQ(views.size(), 6u);
        const auto parallel = sim::simulate_object_views(models, 3, options, gnomon::threads{3});
        const auto more = sim::simulate_object_views(pieces, 1, options, gnomon::threads{2});
        for (std::size_t i = 6; i-- > 0;) {
            EXPECT_TRUE(equal_views(views[i], parallel[i]));
            EXPECT_EQ(views[i].model, i / 3);
            const auto number = (std::uint64_t{i / 3} << 32) + i % 3;
            EXPECT_TRUE(
                equal_views(views[i], sim::simulate_object_view(models[i / 3], number, options)));
        }
        EXPECT_TRUE(equal_views(views[0], more[0]));
        for (std::size_t i = 0; i < 6; ++i) {
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_NE(views[i].pose.position, views[j].pose.position);
        }
        auto other = options;
        other.seed = 6;
        EXPECT_NE(sim::simulate_object_view(models[0], 0, other).pose.position,
                  views[0].pose.position);
    }
}

/// The pose depends on neither noise nor occlusion: views differ in nothing else.
TEST(object_views, of_one_number_have_one_pose) {
    const auto plain = sim::simulate_object_view(pieces[0], 3, coarse());
    auto changed = coarse(0.5);
    changed.beam.sigma = 0.1;
    changed.duration = 2.0;
    const auto other = sim::simulate_object_view(pieces[6], 3, changed);
    EXPECT_EQ(plain.pose.position, other.pose.position);
    EXPECT_EQ(plain.pose.rotation, other.pose.rotation);
}

/// The largest chi^2 of a histogram of n uniform numbers in ten bins that is accepted: the 99.99 %
/// quantile of chi^2 with 9 degrees of freedom.
constexpr double chi_squared_limit = 33.7;

double chi_squared(const std::vector<double>& uniform) {
    std::array<double, 10> counts{};
    for (const double u : uniform)
        counts[static_cast<std::size_t>(std::clamp(10.0 * u, 0.0, 9.0))] += 1.0;
    const double expected = static_cast<double>(uniform.size()) / 10.0;
    double sum = 0.0;
    for (const double c : counts) sum += (c - expected) * (c - expected) / expected;
    return sum;
}

TEST(object_views, are_uniform_on_the_floor) {
    auto options = poses_only();
    std::vector<double> x, y, yaw;
    std::size_t near_ones = 0;
    for (std::uint64_t i = 0; i < 4'000; ++i) {
        const auto view = sim::simulate_object_view(pieces[3], i, options);
        const auto& p = view.pose.position;
        EXPECT_TRUE(p.x() >= 0.5 && p.x() <= 5.5 && std::abs(p.y()) <= 2.5);
        EXPECT_EQ(p.z(), 0.0);
        const double distance = std::hypot(p.x(), p.y());
        EXPECT_GE(distance, 1.2);
        near_ones += distance < 1.5;
        EXPECT_EQ(view.pose.rotation(2, 2), 1.0);
        const double angle = yaw_of(view) / (2 * std::numbers::pi) + 0.5;
        yaw.push_back(angle);
        if (p.x() < 1.2) continue;  // beyond, all places are allowed
        x.push_back((p.x() - 1.2) / 4.3);
        y.push_back((p.y() + 2.5) / 5.0);
    }
    EXPECT_GT(near_ones, 40u);
    EXPECT_LT(chi_squared(x), chi_squared_limit);
    EXPECT_LT(chi_squared(y), chi_squared_limit);
    EXPECT_LT(chi_squared(yaw), chi_squared_limit);
}

TEST(object_views, have_the_parts_of_the_model) {
    sim::scene alone;
    sim::add(alone, pieces[4]);
    const auto view = sim::simulate_object_view(pieces[4], 2, coarse());
    ASSERT_GT(view.truth.scan.size(), 50u);
    EXPECT_EQ(view.points_of_model().size(), view.truth.scan.size());
    std::set<std::string> seen;
    for (std::size_t i = 0; i < view.truth.scan.size(); ++i) {
        EXPECT_EQ(view.truth.objects[i], 0);
        seen.insert(alone.parts()[static_cast<std::size_t>(view.truth.parts[i])].name);
        // In the model's frame the point lies in the model's bounds, but for noise.
        const Eigen::Vector3d p = view.pose.point_in(view.truth.scan.points[i]);
        for (int a = 0; a < 3; ++a) {
            EXPECT_GT(p[a], alone.extent().low[a] - 0.05);
            EXPECT_LT(p[a], alone.extent().high[a] + 0.05);
        }
        EXPECT_EQ(view.truth.scan.viewpoints[i], Eigen::Vector3d(0, 0, 1.2));
    }
    EXPECT_TRUE(seen.contains("seat"));
    EXPECT_TRUE(seen.contains("back"));
}

TEST(object_views, have_noise_of_their_own) {
    auto options = coarse();
    options.beam.sigma = 0.01;
    double sum = 0.0, count = 0.0, product = 0.0;
    for (std::uint64_t i = 0; i < 20; ++i) {
        const auto& truth = sim::simulate_object_view(pieces[5], i, options).truth;
        for (std::size_t j = 0; j < truth.scan.size(); ++j) {
            const double range =
                (truth.scan.points[j] - Eigen::Vector3d(0, 0, 1.2)).dot(truth.directions[j]);
            sum += (range - truth.ranges[j]) * (range - truth.ranges[j]);
            count += 1.0;
        }
        const auto again = sim::simulate_object_view(pieces[5], i + 1, options).truth;
        const std::size_t n = std::min(truth.scan.size(), again.scan.size());
        for (std::size_t j = 0; j < n; ++j)
            product += truth.scan.points[j].x() == again.scan.points[j].x();
    }
    EXPECT_NEAR(std::sqrt(sum / count), 0.01, 0.0005);
    EXPECT_EQ(product, 0.0);
}

/// Only lines that can meet the object are simulated: without noise, the points are those of the
/// whole scan.
TEST(object_views, miss_no_point_of_the_whole_scan) {
    for (std::uint64_t i = 0; i < 30; ++i) {
        SCOPED_TRACE(i);
        auto options = coarse();
        options.beam.sigma = 0.0;
        const auto view = sim::simulate_object_view(pieces[i % 12], i, options);
        sim::scene world;
        sim::add(world, pieces[i % 12], view.pose);
        const sim::vertical scan{.mount = options.sensor, .duration = options.duration};
        const auto whole = sim::simulate(world, scan, options.scanner);
        EXPECT_TRUE(equal_bytes(view.truth.scan.points, whole.scan.points));
    }
}

/// As many points as a whole scan by wide beams, but for their random rotations.
TEST(object_views, miss_no_skimmed_point) {
    auto options = coarse();
    options.beam.footprint = {.waist = 0.002,
                              .divergence = gnomon::radians(0.020),
                              .sub_rays = 9,
                              .rule = sim::echo_rule::averaged};
    double points = 0.0, expected = 0.0;
    for (std::uint64_t i = 0; i < 12; ++i) {
        const auto view = sim::simulate_object_view(pieces[i], i, options);
        sim::scene world;
        sim::add(world, pieces[i], view.pose);
        const sim::vertical scan{.mount = options.sensor, .duration = options.duration};
        points += static_cast<double>(view.truth.scan.size());
        expected += static_cast<double>(
            sim::simulate(world, scan, options.scanner, options.beam).scan.size());
    }
    EXPECT_NEAR(points, expected, 0.005 * expected);
}

/// Clutter and failed readings are points as well: all rays give one.
TEST(object_views, keep_failed_readings_of_all_lines) {
    auto options = coarse();
    options.beam.keep_failed = true;
    const auto view = sim::simulate_object_view(pieces[0], 1, options);
    EXPECT_EQ(view.truth.scan.size(), 160u * 360u);
    EXPECT_LT(view.points_of_model().size(), 2'000u);
    options.beam = {.clutter = 0.5};
    EXPECT_GT(sim::simulate_object_view(pieces[0], 1, options).truth.scan.size(), 20'000u);
}

/// Without noise, the points of the model that remain are those of the unoccluded view, less the
/// share; the hidden ones lie on one side.
TEST(object_views, are_occluded_by_the_given_share) {
    std::set<int> sides;
    for (const double share : {0.1, 0.3, 0.5, 0.8}) {
        double hidden = 0.0, all = 0.0;
        for (std::uint64_t i = 0; i < 24; ++i) {
            SCOPED_TRACE(testing::Message() << share << ", view " << i);
            const auto& model = pieces[i % pieces.size()];
            auto options = coarse(share);
            options.beam.sigma = 0.0;
            const auto occluded = sim::simulate_object_view(model, i, options);
            options.occluded_share = 0.0;
            const auto whole = sim::simulate_object_view(model, i, options);
            std::set<std::array<double, 3>> left;
            for (const auto j : occluded.points_of_model()) {
                const auto& p = occluded.truth.scan.points[j];
                left.insert({p.x(), p.y(), p.z()});
            }
            // Directions of the hidden and of the other points, about the direction of the model.
            std::array<Eigen::Vector2d, 2> lowest, highest;
            lowest.fill({9, 9});
            highest.fill({-9, -9});
            const double heading = std::atan2(whole.pose.position.y(), whole.pose.position.x());
            for (const auto& p : whole.truth.scan.points) {
                const bool stays = left.erase({p.x(), p.y(), p.z()}) > 0;
                const Eigen::Vector3d q = sim::yaw(gnomon::radians(heading)).direction_in(p);
                const Eigen::Vector2d at(std::atan2(q.y(), q.x()), (q.z() - 1.2) / q.x());
                lowest[stays] = lowest[stays].cwiseMin(at);
                highest[stays] = highest[stays].cwiseMax(at);
            }
            EXPECT_TRUE(left.empty());  // the board shows no new points
            const auto n = static_cast<double>(whole.truth.scan.size());
            const auto rest = static_cast<double>(occluded.points_of_model().size());
            if (n < 100) continue;
            hidden += n - rest;
            all += n;
            // Of a scan line, whose points may be equally high, all are hidden or none.
            EXPECT_NEAR((n - rest) / n, share, 0.08);
            const bool is_left = lowest[0].x() > highest[1].x() - 1e-3;
            const bool is_right = highest[0].x() < lowest[1].x() + 1e-3;
            const bool is_bottom = highest[0].y() < lowest[1].y() + 0.05;
            EXPECT_TRUE(is_left || is_right || is_bottom);
            sides.insert(is_left ? 0 : is_right ? 1 : 2);
            // The board is well in front of the model.
            for (std::size_t j = 0; j < occluded.truth.scan.size(); ++j) {
                EXPECT_TRUE(occluded.truth.objects[j] == 0 || occluded.truth.objects[j] == 1);
            }
        }
        EXPECT_NEAR(hidden / all, share, 0.01);
    }
    EXPECT_EQ(sides.size(), 3u);
}

TEST(object_views, may_be_hidden_as_a_whole) {
    for (std::uint64_t i = 0; i < 6; ++i) {
        const auto view = sim::simulate_object_view(pieces[i], i, coarse(1.0));
        EXPECT_GT(view.truth.scan.size(), 0u);
        EXPECT_TRUE(view.points_of_model().empty());
    }
}

/// Far away, or with a thin object, a view of few points or none is a view as well.
TEST(object_views, may_have_no_points) {
    sim::scene wire;
    wire.add_object("wire", sim::box{0.001, 0.001, 0.001});
    auto options = coarse();
    options.places = {{25, 0, 0}, {28, 0, 0}};
    for (const double share : {0.0, 0.5}) {
        options.occluded_share = share;
        const auto view = sim::simulate_object_view({"wire", wire}, 1, options);
        EXPECT_TRUE(view.truth.scan.points.empty());
        EXPECT_TRUE(view.points_of_model().empty());
        EXPECT_GE(view.pose.position.x(), 25.0);
        const auto few = sim::simulate_object_view(pieces[3], 1, options);
        EXPECT_LT(few.truth.scan.size(), 20u);
        EXPECT_TRUE(sim::simulate_object_view({"empty", sim::scene{}}, 1, options)
                        .truth.scan.points.empty());
    }
    EXPECT_TRUE(sim::simulate_object_views(pieces, 0, options).empty());
    EXPECT_TRUE(sim::simulate_object_views({}, 5, options).empty());
}

/// An object all around the sensor is hidden in front at most; nothing is NaN or endless.
TEST(object_views, may_be_around_the_sensor) {
    sim::scene dome;
    dome.add_object("dome", sim::sphere{3.0});
    auto options = coarse(0.5);
    options.scanner.field_of_view = gnomon::degrees(360);
    options.places = {{0, 0, 0}, {0, 0, 0}};
    options.nearest = 0.0;
    const auto view = sim::simulate_object_view({"dome", dome}, 1, options);
    EXPECT_GT(view.points_of_model().size(), 100u);
    for (const auto& p : view.truth.scan.points) EXPECT_TRUE(gnomon::is_finite(p));
}

/// Beams as wide as real ones report ranges between the seat and the floor-level legs behind it.
TEST(object_views, have_skimmed_points_if_beams_are_wide) {
    auto options = coarse();
    options.beam.footprint = {
        .divergence = gnomon::radians(0.010), .sub_rays = 9, .rule = sim::echo_rule::averaged};
    const auto view = sim::simulate_object_view(pieces[1], 3, options);
    const auto mixed =
        std::count(view.truth.echoes.begin(), view.truth.echoes.end(), sim::echo::mixed);
    EXPECT_GT(mixed, 10);
}

/// About 1,940 points per view at 8 s: the figure of the protocol.
TEST(object_views, have_as_many_points_as_the_protocol) {
    const auto views = sim::simulate_object_views(pieces, 5, {.seed = 3}, gnomon::threads{2});
    double points = 0.0;
    for (const auto& view : views) points += static_cast<double>(view.truth.scan.size());
    points /= static_cast<double>(views.size());
    std::printf("%.0f points per view\n", points);
    EXPECT_GT(points, 1'400.0);
    EXPECT_LT(points, 2'500.0);
}

/// The call of the documentation.
TEST(object_views, are_simulated_for_training_and_test) {
    // [object_views]
    const auto models = sim::furniture_models();
    const auto training = sim::simulate_object_views(models, 2, {.seed = 1}, gnomon::threads{});

    const sim::object_view_options occluded{.occluded_share = 0.5, .seed = 2};
    const sim::object_view test = sim::simulate_object_view(models[3], 7, occluded);
    const std::vector<gnomon::point_index> visible = test.points_of_model();
    // [object_views]
    EXPECT_EQ(training.size(), 24u);
    EXPECT_LT(visible.size(), test.truth.scan.size());
}

TEST(object_views, refuse_invalid_options) {
    std::vector<sim::object_view_options> bad(10);
    bad[0].occluded_share = -0.1;
    bad[1].occluded_share = 1.1;
    bad[2].occluded_share = clouds::nan;
    bad[3].nearest = clouds::nan;
    bad[4].nearest = 100.0;  // no place is as far
    bad[5].places.low.x() = clouds::nan;
    bad[6].places.high.y() = -3.0;
    bad[7].sensor.rotation(0, 1) = 0.5;
    bad[8].beam.sigma = -1.0;
    bad[9].duration = clouds::nan;
    for (std::size_t i = 0; i < bad.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_THROW((void)sim::simulate_object_view(pieces[0], 0, bad[i]), std::invalid_argument);
        EXPECT_THROW((void)sim::simulate_object_views(pieces, 1, bad[i], gnomon::threads{2}),
                     std::invalid_argument);
    }
}

}  // namespace
