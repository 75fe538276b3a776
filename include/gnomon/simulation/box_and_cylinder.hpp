// SPDX-License-Identifier: BSL-1.0
/// @file
/// The simulated point cloud of the thesis's first benchmark: a box and a cylinder scanned on a
/// regular angular raster, with noise along the rays.
///
/// Klasing 2010, Sec. 3.2.6, Scenario I, Fig. 3.3.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace gnomon::simulation {

/// Parameters of the benchmark. The angular step of the raster is computed from the number of
/// points.
struct box_and_cylinder {
    double sigma = 0.015;         ///< standard deviation of the range [m]
    double scale = 1.0;           ///< of both objects, about their positions on the floor
    std::size_t points = 14'200;  ///< target, met within 1 % (few points, small objects: 3 %)
    std::uint64_t seed = 1;
};

/// Scans scenes::box_and_cylinder(scale) in vertical scan lines from right to left. The ground
/// truth uses the numbers of that scene.
///
/// @throws std::invalid_argument  unless 0.1 <= scale <= 1.5, sigma is finite and not negative, and
///                                the number of points is from 1,000 to 10,000,000 and at most
///                                4e8 scale^2: small objects are hit by few of the rays
/// Complexity: at most nine scans of 80 x 80 degrees, eight of them to find the step; memory for
/// the points only. The same seed gives the same bytes.
template <execution X = sequential>
[[nodiscard]] true_scan simulate(const box_and_cylinder& parameters, const X& run = {}) {
    gnomon::detail::require(parameters.scale >= 0.1 && parameters.scale <= 1.5,
                            "box_and_cylinder: scale must lie in [0.1, 1.5]");
    gnomon::detail::require(parameters.points >= 1000 && parameters.points <= 10'000'000,
                            "box_and_cylinder: ask for 1,000 to 10,000,000 points");
    gnomon::detail::require(
        static_cast<double>(parameters.points) <= 4e8 * parameters.scale * parameters.scale,
        "box_and_cylinder: too many points for objects of this scale");
    const scene world = scenes::box_and_cylinder(parameters.scale);
    const bvh_caster caster(world);
    constexpr double field = 80.0;  // degrees; wider than the objects as seen from the sensor
    const auto scan_with = [&](double step, const beam& b) {
        const horizontal trajectory{
            .mount = world.sensor, .duration = 1.0, .sweep = degrees(field)};
        const scanner finder{.field_of_view = degrees(field),
                             .resolution = degrees(step),
                             .frequency = field / step,
                             .min_range = 0.0};
        return simulate(world, caster, trajectory, finder, b, run);
    };

    // The number of hits is inversely proportional to the square of the step, except for rounding
    // at the outlines.
    double step = 0.3 * parameters.scale;
    double best = step;
    double least = std::numeric_limits<double>::infinity();
    for (int trial = 0; trial < 8 && least >= 0.002; ++trial) {
        const double returns = static_cast<double>(scan_with(step, {}).scan.size());
        const double ratio = (returns + 1.0) / static_cast<double>(parameters.points);
        if (std::abs(ratio - 1.0) < least) {
            least = std::abs(ratio - 1.0);
            best = step;
        }
        step *= std::sqrt(ratio);
    }
    return scan_with(best, {.sigma = parameters.sigma, .seed = parameters.seed});
}

}  // namespace gnomon::simulation
