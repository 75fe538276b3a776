// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

using gnomon::degrees;
using sim::echo;

const sim::scene kitchen = sim::scenes::kitchen();
const sim::rotational around{.mount = kitchen.sensor};

/// A room is closed: every beam returns.
TEST(simulate, returns_a_point_for_every_beam) {
    EXPECT_EQ(sim::simulate(kitchen, around, sim::densities::low()).scan.size(), 7'200u);
    EXPECT_EQ(sim::simulate(kitchen, around, sim::densities::medium()).scan.size(), 28'800u);
    EXPECT_EQ(sim::simulate(kitchen, around, sim::densities::high()).scan.size(), 115'200u);
}

TEST(simulate, returns_the_truth_about_each_point) {
    const auto truth = sim::simulate(kitchen, around, sim::densities::low());
    const Eigen::Vector3d v = kitchen.sensor.position;
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d p = truth.scan.points[i];
        EXPECT_EQ(truth.scan.viewpoints[i], v);
        EXPECT_EQ(p, (v + truth.ranges[i] * truth.directions[i]).eval());
        EXPECT_LT(truth.normals[i].dot(truth.directions[i]), 1e-12);
        EXPECT_EQ(truth.echoes[i], echo::surface);
        const auto surface = static_cast<std::size_t>(truth.surfaces[i]);
        EXPECT_EQ(truth.parts[i], kitchen.surfaces()[surface].part);
        const auto part = static_cast<std::size_t>(truth.parts[i]);
        EXPECT_EQ(truth.objects[i], kitchen.parts()[part].object);
        if (kitchen.parts()[part].name == "floor") {
            EXPECT_NEAR(p.z(), 0.0, 1e-12);
        }
    }
}

/// Also of a wide beam that meets the floor at a grazing angle.
TEST(simulate, returns_the_truth_for_wide_beams) {
    sim::scene world;
    world.add_object("floor", sim::plane_patch{60, 60});
    const sim::vertical scan{.mount = sim::at(0, 0, 1)};
    sim::scanner finder = sim::densities::low();
    finder.max_range = 15.0;  // farther away the floor is more than one echo
    const auto truth = sim::simulate(
        world, scan, finder, {.footprint = {.waist = 0.002, .divergence = gnomon::radians(0.004)}});
    ASSERT_GT(truth.scan.size(), 1000u);
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        const Eigen::Vector3d p = truth.scan.viewpoints[i] + truth.ranges[i] * truth.directions[i];
        if (truth.ranges[i] < 12.0) {
            EXPECT_NEAR(p.z(), 0.0, 1e-9);
        }
    }
}

TEST(simulate, scatters_along_the_rays_only) {
    for (const double sigma : {0.015, 0.030}) {
        const auto noisy = sim::simulate(kitchen, around, {}, {.sigma = sigma, .seed = 7});
        ASSERT_EQ(noisy.scan.size(), 115'200u);
        double sum = 0.0;
        for (std::size_t i = 0; i < noisy.scan.size(); ++i) {
            const Eigen::Vector3d d = noisy.scan.points[i] - kitchen.sensor.position;
            const double along = d.dot(noisy.directions[i]);
            EXPECT_LT((d - along * noisy.directions[i]).norm(), 1e-14);
            sum += (along - noisy.ranges[i]) * (along - noisy.ranges[i]);
        }
        const double deviation = std::sqrt(sum / static_cast<double>(noisy.scan.size()));
        EXPECT_NEAR(deviation, sigma, 0.02 * sigma);
    }
}

bool same_bytes(const sim::true_scan& a, const sim::true_scan& b) {
    const auto same = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0;
    };
    return same(a.scan.points, b.scan.points) && same(a.normals, b.normals) &&
           same(a.surfaces, b.surfaces) && same(a.ranges, b.ranges) && same(a.echoes, b.echoes);
}

const sim::beam all_at_once{.sigma = 0.01,
                            .sigma_per_meter = 0.001,
                            .grazing = 1.0,
                            .clutter = 0.01,
                            .failure = 0.02,
                            .footprint = {.divergence = gnomon::radians(0.004), .sub_rays = 7},
                            .keep_failed = true,
                            .seed = 3};

TEST(simulate, gives_the_same_bytes_on_any_number_of_threads) {
    const auto one = sim::simulate(kitchen, around, sim::densities::medium(), all_at_once);
    for (const unsigned n : {1u, 2u, 4u}) {
        EXPECT_TRUE(same_bytes(one, sim::simulate(kitchen, around, sim::densities::medium(),
                                                  all_at_once, gnomon::threads{n})));
    }
    sim::beam other = all_at_once;
    other.seed = 4;
    EXPECT_FALSE(same_bytes(one, sim::simulate(kitchen, around, sim::densities::medium(), other)));
}

/// Sigma and width of nothing leave the ideal scan, bit for bit.
TEST(simulate, ideal_limit_is_bit_for_bit) {
    const auto ideal = sim::simulate(kitchen, around, sim::densities::low());
    const sim::beam nothing{.sigma = 0.0,
                            .grazing = 1.0,
                            .footprint = {.sub_rays = 37, .rule = sim::echo_rule::averaged},
                            .seed = 99};
    EXPECT_TRUE(same_bytes(ideal, sim::simulate(kitchen, around, sim::densities::low(), nothing)));
}

TEST(simulate, counts_failed_readings) {
    const auto truth = sim::simulate(kitchen, around, {}, all_at_once, gnomon::threads{});
    ASSERT_EQ(truth.scan.size(), 115'200u);
    std::vector<double> count(4, 0.0);
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        ++count[static_cast<std::size_t>(truth.echoes[i])];
        const bool real = truth.echoes[i] == echo::surface || truth.echoes[i] == echo::mixed;
        EXPECT_EQ(truth.surfaces[i] == sim::nothing, !real);
        EXPECT_EQ(std::isnan(truth.ranges[i]), !real);
        EXPECT_EQ(truth.normals[i].isZero(0.0), !real);
        if (truth.echoes[i] == echo::none) {
            EXPECT_NEAR((truth.scan.points[i] - kitchen.sensor.position).norm(), 30.0, 1e-9);
        }
    }
    EXPECT_NEAR(count[2], 1152.0, 4 * std::sqrt(1152.0));
    EXPECT_NEAR(count[3], 2304.0, 4 * std::sqrt(2304.0));
    EXPECT_GT(count[1], 500.0);
    EXPECT_LT(count[1], 12'000.0);
}

/// A drive past a wall: every scan line has a view point of its own.
TEST(simulate, moves_the_view_point_with_the_sensor) {
    sim::scene world;
    world.add_object("wall", sim::box{0.1, 20, 4}, sim::at(3, 0, 0));
    const sim::along drive(2.0,
                           [](double t) { return sim::at(0, t - 1, 0) * sim::roll(degrees(90)); });
    const auto truth = sim::simulate(world, drive, sim::densities::low());
    ASSERT_GT(truth.scan.size(), 500u);
    EXPECT_EQ(truth.scan.viewpoints.positions().size(), 20u);
    for (std::size_t i = 0; i < truth.scan.size(); ++i) {
        EXPECT_NEAR(truth.scan.viewpoints[i].y(), truth.scan.points[i].y(), 1e-12);
    }
    // Standing still is the limit of moving slowly.
    const sim::fixed still{.mount = sim::at(0, 0, 0) * sim::roll(degrees(90)), .duration = 2.0};
    const sim::along crawl(2.0, [&](double t) { return sim::at(0, 1e-15 * t, 0) * still(t); });
    const auto a = sim::simulate(world, still, sim::densities::low());
    const auto b = sim::simulate(world, crawl, sim::densities::low());
    ASSERT_EQ(a.scan.size(), b.scan.size());
    for (std::size_t i = 0; i < a.scan.size(); ++i)
        EXPECT_LT((a.scan.points[i] - b.scan.points[i]).norm(), 1e-13);
}

TEST(simulate, sees_no_farther_and_no_nearer_than_the_scanner) {
    sim::scanner finder = sim::densities::low();
    finder.min_range = 1.0;
    finder.max_range = 2.0;
    const auto truth = sim::simulate(kitchen, around, finder);
    EXPECT_GT(truth.scan.size(), 100u);
    for (const double range : truth.ranges) {
        EXPECT_GE(range, 1.0);
        EXPECT_LE(range, 2.0);
    }
}

TEST(simulate, of_nothing_is_nothing) {
    const auto truth = sim::simulate(sim::scene(), around, sim::densities::low());
    EXPECT_EQ(truth.scan.size(), 0u);
    EXPECT_TRUE(truth.scan.viewpoints.covers(0));
    EXPECT_EQ(sim::simulate(kitchen, sim::fixed{.duration = 0.0}).scan.size(), 0u);
}

TEST(simulate, rejects_invalid_input) {
    const auto scanning = [](double duration, const sim::scanner& finder, const sim::beam& b) {
        return sim::simulate(kitchen, sim::fixed{.duration = duration}, finder, b);
    };
    EXPECT_THROW((void)scanning(-1, {}, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning(clouds::nan, {}, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning(clouds::infinity, {}, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning(1e7, {}, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning(1, {.frequency = -1}, {}), std::invalid_argument);
    EXPECT_THROW((void)scanning(1, {}, {.sigma = -1}), std::invalid_argument);
    EXPECT_THROW((void)scanning(1, {.resolution = gnomon::radians(1e-300)}, {}),
                 std::invalid_argument);
}

/// A sensor that is no rigid motion would give NaN, or ranges of another unit.
TEST(simulate, refuses_poses_that_are_none) {
    sim::pose doubled;
    doubled.rotation *= 2.0;
    sim::pose mirrored;
    mirrored.rotation(1, 1) = -1.0;
    const sim::scanner finder = sim::densities::low();
    for (const sim::pose& bad : {doubled, mirrored, sim::at(clouds::nan, 0, 0)}) {
        EXPECT_THROW((void)sim::simulate(kitchen, sim::fixed{.mount = bad}, finder),
                     std::invalid_argument);
    }
    EXPECT_THROW(
        (void)sim::simulate(kitchen, sim::horizontal{.sweep = degrees(clouds::nan)}, finder),
        std::invalid_argument);
}

TEST(simulate, refuses_the_caster_of_another_scene) {
    const sim::bvh_caster caster(kitchen);
    EXPECT_THROW((void)sim::simulate(sim::scene(), caster, around, sim::densities::low()),
                 std::invalid_argument);
}

/// What meets nothing costs nothing: a sky full of rays, and a few that hit.
TEST(simulate, stores_only_readings_with_a_point) {
    const sim::scene world = sim::scenes::plate(5);
    const sim::bvh_caster caster(world);
    const sim::scanner finder = sim::densities::low();
    const sim::horizontal scan;
    const auto ray_of = [&](std::size_t i) {
        const auto sensor = scan((static_cast<double>(i / 180) + 0.5) / 10.0);
        return sim::ray{sensor.position, sensor.direction_out(finder.direction(i % 180))};
    };
    const sim::detail::instrument<sim::bvh_caster> read(caster, {}, 0.1, 30.0);
    std::size_t kept = 0;
    std::size_t room = 0;
    for (const auto& chunk :
         sim::detail::read_rays<sim::bvh_caster>(read, {}, 7'200, ray_of, gnomon::sequential{})) {
        kept += chunk.size();
        room += chunk.capacity();
    }
    EXPECT_EQ(kept, sim::simulate(world, scan, finder).scan.size());
    EXPECT_GT(kept, 20u);
    EXPECT_LE(room, 2 * kept);
}

}  // namespace
