// SPDX-License-Identifier: BSL-1.0
/// @file
/// A furnished room with doors and windows, scanned all around from a tripod.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

inline sim::scene room_with_openings(std::uint64_t seed) {
    sim::scene world = sim::scenes::furnished_room(
        {.pieces = static_cast<int>(4 + 2 * (seed % 5)), .seed = seed, .openings = true});
    // A place near the middle that is half a metre away from everything.
    const Eigen::Vector3d size = world.shapes().front().extent.size();
    const sim::bvh_caster caster(world);
    gnomon::random_stream random(seed, 2);
    constexpr double least_distance = 0.5;  // [m]
    for (bool is_free = false; !is_free;) {
        world.sensor = sim::at(random.uniform(0.25, 0.75) * size.x(),
                               random.uniform(-0.25, 0.25) * size.y(), random.uniform(1.4, 1.7)) *
                       sim::pitch(gnomon::degrees(-90));
        is_free = true;
        for (int k = 0; k < 64 && is_free; ++k) {
            const double z = random.uniform(-1.0, 1.0), level = std::sqrt(1.0 - z * z);
            const double azimuth = random.uniform(0.0, 2.0 * std::numbers::pi);
            const auto hit = caster(
                {world.sensor.position, {level * std::cos(azimuth), level * std::sin(azimuth), z}});
            is_free = !hit || hit->range > least_distance;
        }
    }
    return world;
}

/// Scan lines of 270 degrees that intersect in the zenith, half a degree apart: 194,400 rays.
inline sim::true_scan scan_all_around(const sim::scene& world, double sigma, std::uint64_t seed,
                                      const gnomon::threads& threads) {
    const sim::scanner finder{.field_of_view = gnomon::degrees(270),
                              .resolution = gnomon::degrees(0.5)};
    return sim::simulate(world, sim::rotational{.mount = world.sensor, .duration = 9.0}, finder,
                         {.sigma = sigma, .seed = seed}, threads);
}
