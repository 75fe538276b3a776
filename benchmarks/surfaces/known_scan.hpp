// SPDX-License-Identifier: BSL-1.0
/// @file
/// Scans with the true position and normal of each point: of a kitchen, of furnished rooms, of the
/// inside of random polyhedra, of depth cameras, and of the road of a street.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "furnished.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

/// One radian [degrees].
inline constexpr double degrees_of_radian = 57.29577951308232;

/// A scan with the truth of each point.
struct known_scan {
    std::string scene;
    double noise = 0.0;  ///< standard deviation of the ranges [mm]; 0 of a camera
    gnomon::scan scan;
    std::vector<Eigen::Vector3d> positions, normals;  ///< true ones [m]

    /// Whether two points truly lie on one plane.
    [[nodiscard]] bool on_one_plane(std::size_t i, std::size_t j) const {
        constexpr double flat = 1e-9, near = 1e-6;  // of cosines, and [m]: of rounding
        return normals[i].dot(normals[j]) > 1.0 - flat &&
               std::abs(normals[i].dot(positions[j] - positions[i])) < near;
    }
};

inline known_scan known(std::string scene, double noise, const sim::true_scan& truth) {
    known_scan s{std::move(scene), noise, truth.scan, {}, truth.normals};
    for (std::size_t i = 0; i < truth.scan.size(); ++i)
        s.positions.push_back(truth.scan.viewpoints[i] + truth.ranges[i] * truth.directions[i]);
    return s;
}

/// The kitchen at high density.
inline known_scan kitchen(double noise) {
    const sim::scene world = sim::scenes::kitchen();
    return known("kitchen", noise,
                 sim::simulate(world, sim::rotational{.mount = world.sensor},
                               sim::densities::high(), {.sigma = 1e-3 * noise, .seed = 4711}));
}

inline known_scan room(double noise, std::uint64_t seed) {
    const setting how{noise, "whole", trajectories[seed % trajectories.size()]};
    const sim::scene world = furnished(seed);
    return known("room " + std::to_string(seed), noise,
                 scan_of(world, sim::bvh_caster(world), how, 1000 * seed + 2));
}

/// The inside of a random convex polyhedron: no point is near a surface that it is not on, but at
/// edges. One ray per square of 0.8 degrees.
inline known_scan convex_room(double noise, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    struct wall {
        Eigen::Vector3d normal;
        double distance;
    };
    std::vector<wall> walls;
    for (int w = 0; w < 14; ++w) {
        Eigen::Vector3d n(random.gaussian(), random.gaussian(), random.gaussian());
        walls.push_back({n.normalized(), random.uniform(1.0, 5.0)});
    }
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1.0, 1.0})
            walls.push_back({side * Eigen::Vector3d::Unit(axis), random.uniform(2.0, 6.0)});
    known_scan s{"convex " + std::to_string(seed), noise, {}, {}, {}};
    s.scan.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
    const double step = 0.8 / degrees_of_radian;
    for (double elevation = -90.0 / degrees_of_radian + step / 2;
         elevation < 90.0 / degrees_of_radian; elevation += step) {
        const double across = step / std::max(0.02, std::cos(elevation));
        for (double azimuth = random.uniform(0.0, across); azimuth < 360.0 / degrees_of_radian;
             azimuth += across) {
            const Eigen::Vector3d u(std::cos(elevation) * std::cos(azimuth),
                                    std::cos(elevation) * std::sin(azimuth), std::sin(elevation));
            double range = std::numeric_limits<double>::infinity();
            const wall* hit = nullptr;
            for (const wall& w : walls) {
                const double cosine = u.dot(w.normal);
                if (cosine > 1e-6 && w.distance / cosine < range) {
                    range = w.distance / cosine;
                    hit = &w;
                }
            }
            s.positions.push_back(range * u);
            s.normals.push_back(-hit->normal);
            s.scan.points.push_back((range + 1e-3 * noise * random.gaussian()) * u);
        }
    }
    return s;
}

/// The image of a depth camera, whose depths come in steps.
inline known_scan image(std::uint64_t seed) {
    const sim::scene world = furnished(seed);
    return known("camera " + std::to_string(seed), 0.0,
                 sim::simulate(world, world.sensor, sim::scanners::structured_light(),
                               {.seed = 1000 * seed + 2}));
}

/// The road of a street, seen by a lidar of 32 beams, which may stand on a car.
inline known_scan street(bool own_car) {
    const sim::scene world = sim::scenes::street({.own_car = own_car, .seed = 10'001});
    const sim::spinning_lidar lidar = sim::scanners::velodyne_hdl_32e();
    known_scan s = known(own_car ? "street, own car" : "street, ground", 20.0,
                         sim::simulate(world,
                                       sim::driving{.mount = world.sensor,
                                                    .duration = lidar.revolution(),
                                                    .velocity = Eigen::Vector3d(0.0, 0.0, 0.0)},
                                       lidar, {.sigma = 0.02, .seed = 10'001}));
    for (std::size_t i = 0; i < s.normals.size(); ++i)  // without truth, others do not count
        if (std::abs(s.positions[i].z()) > 1e-6) s.normals[i] = Eigen::Vector3d(0.0, 0.0, 0.0);
    return s;
}
