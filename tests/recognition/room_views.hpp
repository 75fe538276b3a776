// SPDX-License-Identifier: BSL-1.0
/// @file
/// A small simulated room for tests of verification: a wall, a floor and some furniture.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/furnished_room.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/sample_surface.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace room_views {

namespace sim = gnomon::simulation;
namespace rec = gnomon::recognition;

constexpr double sigma = 0.005;  // [m]

/// A scan of an empty room with the given models at the given poses.
inline sim::true_scan scan_of(
    const std::vector<std::pair<sim::furniture_model, gnomon::rigid_motion>>& pieces,
    std::uint64_t seed) {
    sim::scene world = sim::scenes::furnished_room({.pieces = 0, .seed = seed});
    for (const auto& [model, pose] : pieces) sim::add(world, model, pose);
    return sim::simulate(
        world, sim::vertical{.mount = world.sensor, .duration = 4.0, .sweep = gnomon::degrees(100)},
        sim::scanner{}, sim::beam{.sigma = sigma, .seed = seed});
}

/// The surface of a model, in samples of 3 cm.
inline rec::surface_model surface_of(const sim::furniture_model& model) {
    constexpr double spacing = 0.03;
    const auto samples = sim::sample_surface(model, {.spacing = spacing});
    return rec::surface_model(samples, samples, spacing, {}, &sim::surface_sample::position);
}

}  // namespace room_views
