// SPDX-License-Identifier: BSL-1.0
/// @file
/// Surface patches of known curvature at the origin: heights z over the tangent plane there. The
/// sensor is at z = +infinity.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "laws/clouds.hpp"
#include <gnomon/features/curvature.hpp>
#include <gnomon/features/surface_type.hpp>

namespace patches {

inline const Eigen::Vector3d up(0.0, 0.0, 1.0);
inline const Eigen::Vector3d zero(0, 0, 0);

/// A surface and its true curvature at the origin.
struct known_surface {
    std::string name;
    double (*height)(double x, double y);
    double kappa1;
    double kappa2;
    gnomon::surface_type type;
};

/// One patch of each surface type, with radii of 0.5 m to 2 m.
inline std::vector<known_surface> all() {
    using gnomon::surface_type;
    return {
        {"ball", [](double x, double y) { return std::sqrt(4.0 - x * x - y * y) - 2.0; }, -0.5,
         -0.5, surface_type::peak},
        {"bowl", [](double x, double y) { return 2.0 - std::sqrt(4.0 - x * x - y * y); }, 0.5, 0.5,
         surface_type::pit},
        {"column", [](double, double y) { return std::sqrt(0.25 - y * y) - 0.5; }, 0.0, -2.0,
         surface_type::ridge},
        {"pipe from inside", [](double, double y) { return 0.5 - std::sqrt(0.25 - y * y); }, 2.0,
         0.0, surface_type::valley},
        {"plane", [](double, double) { return 0.0; }, 0.0, 0.0, surface_type::flat},
        {"z = xy", [](double x, double y) { return x * y; }, 1.0, -1.0, surface_type::minimal},
        {"saddle, more down than up", [](double x, double y) { return 0.25 * x * x - y * y; }, 0.5,
         -2.0, surface_type::saddle_ridge},
        {"saddle, more up than down", [](double x, double y) { return x * x - 0.25 * y * y; }, 2.0,
         -0.5, surface_type::saddle_valley},
    };
}

/// The n points of a surface within `radius` [m] of the origin along x and y, spread evenly; noise
/// of standard deviation `sigma` along z.
inline clouds::cloud neighborhood_of(const known_surface& surface, std::size_t n, double radius,
                                     std::uint64_t seed, double sigma = 0.0) {
    gnomon::random_stream random(seed, 9);
    clouds::cloud neighbors;
    for (std::size_t i = 0; i < n; ++i) {
        const double r = radius * std::sqrt(random.uniform());
        const double phi = 2.0 * std::numbers::pi * random.uniform();
        const double x = r * std::cos(phi);
        const double y = r * std::sin(phi);
        neighbors.push_back({x, y, surface.height(x, y) + sigma * random.gaussian()});
    }
    return neighbors;
}

/// n points on the unit sphere, each of the same area (Fibonacci lattice).
inline clouds::cloud on_sphere(std::size_t n) {
    clouds::cloud points;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * static_cast<double>(i) + 1.0) / static_cast<double>(n);
        const double r = std::sqrt(1.0 - z * z);
        const double phi = golden * static_cast<double>(i);
        points.push_back({r * std::cos(phi), r * std::sin(phi), z});
    }
    return points;
}

}  // namespace patches
