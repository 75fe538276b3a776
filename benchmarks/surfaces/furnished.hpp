// SPDX-License-Identifier: BSL-1.0
/// @file
/// Simulated scans of furnished rooms, by noise, density and trajectory.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

/// How a room is scanned.
struct setting {
    double noise;            ///< standard deviation of the ranges [mm]
    std::string density;     ///< of the scan lines
    std::string trajectory;  ///< "moving" is rotational on a path of 10 cm: each scan line has a
                             ///< view point of its own

    [[nodiscard]] double sigma() const { return 1e-3 * noise; }
};

inline constexpr std::array noises{5.0, 15.0, 30.0};
inline constexpr std::array densities{"half", "whole", "double"};
inline constexpr std::array trajectories{"rotational", "vertical", "horizontal", "moving"};

inline sim::scene furnished(std::uint64_t seed) {
    return sim::scenes::furnished_room(
        {.pieces = static_cast<int>(4 + 2 * (seed % 5)), .seed = seed});
}

inline sim::true_scan scan_of(const sim::scene& world, const sim::bvh_caster& caster,
                              const setting& s, std::uint64_t seed) {
    const sim::pose mount = world.sensor;
    const double seconds = s.density == "half" ? 2.0 : s.density == "whole" ? 4.0 : 8.0;
    const auto along = [&](const auto& way) {
        return sim::simulate(world, caster, way, {}, {.sigma = s.sigma(), .seed = seed});
    };
    if (s.trajectory == "horizontal")
        return along(sim::horizontal{.mount = mount, .duration = seconds});
    if (s.trajectory == "vertical")
        return along(sim::vertical{.mount = mount, .duration = seconds});
    const sim::rotational turning{.mount = {}, .duration = seconds};
    if (s.trajectory == "rotational")
        return along(sim::rotational{.mount = mount, .duration = seconds});
    return along(sim::along(seconds, [=](double time) {
        constexpr double path = 0.10;  // [m], to the left
        return mount * sim::at(0.0, path * (time / seconds - 0.5), 0.0) * turning(time);
    }));
}
