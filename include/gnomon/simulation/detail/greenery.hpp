// SPDX-License-Identifier: BSL-1.0
/// @file
/// Trees and hedges: many small leaves of random attitude. Rays pass between the leaves, and the
/// surface is as rough as the leaves are deep.
///
/// A ray through leaves of area A, of which there are n per cubic metre in all attitudes, meets
/// n A / 2 of them per metre on average.
#pragma once

#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace gnomon::simulation::detail {

/// A rotation about z by an angle of uniform distribution, then of the z axis to a direction of
/// uniform distribution on the sphere.
[[nodiscard]] inline pose any_attitude(random_stream& random) {
    const double heading = random.uniform(-std::numbers::pi, std::numbers::pi);
    const double slope = std::acos(random.uniform(-1.0, 1.0));
    const double spin = random.uniform(-std::numbers::pi, std::numbers::pi);
    return yaw(radians(heading)) * pitch(radians(slope)) * yaw(radians(spin));
}

/// Square leaves on one surface, "leaves", that fill a volume [m^3] so that a ray meets `per_meter`
/// of them per metre.
/// @param edge   of a leaf [m]
/// @param place  draws the middle of a leaf, uniform in the volume
[[nodiscard]] triangle_mesh foliage(random_stream& random, double volume, double per_meter,
                                    double edge, auto&& place) {
    mesh_builder b;
    b.surface("leaves");
    const auto count = static_cast<int>(std::ceil(2.0 * per_meter * volume / (edge * edge)));
    for (int i = 0; i < count; ++i) {
        pose leaf = any_attitude(random);
        leaf.position = place();
        const double h = 0.5 * edge;
        b.face({leaf.point_out({-h, -h, 0.0}), leaf.point_out({h, -h, 0.0}),
                leaf.point_out({h, h, 0.0}), leaf.point_out({-h, h, 0.0})});
    }
    return b.mesh();
}

/// Adds a tree with the parts "trunk" and "crown", an ellipsoid of leaves above 2.3 m.
inline void add_tree(scene& world, std::string name, const pose& at, random_stream& random) {
    const double radius = random.uniform(1.2, 1.9);
    const double half_height = radius * random.uniform(0.9, 1.5);
    const double middle = 2.3 + half_height;
    const double trunk = random.uniform(0.10, 0.18);
    const std::int32_t object = world.add_object(std::move(name));
    world.add(world.add_part(object, "trunk"), cylinder{trunk, middle}, at);
    const double volume = 4.0 / 3.0 * std::numbers::pi * radius * radius * half_height;
    world.add(world.add_part(object, "crown"),
              foliage(random, volume, 0.7, 0.16,
                      [&] {
                          const Eigen::Vector3d direction =
                              any_attitude(random).direction_out({0.0, 0.0, 1.0});
                          const double share = std::cbrt(random.uniform());
                          return Eigen::Vector3d(direction.x() * radius * share,
                                                 direction.y() * radius * share,
                                                 middle + direction.z() * half_height * share);
                      }),
              at);
}

/// Adds a hedge of leaves that fill a box.
inline void add_hedge(scene& world, std::string name, const pose& at, const bounds& extent,
                      random_stream& random) {
    const Eigen::Vector3d size = extent.size();
    world.add_object(std::move(name),
                     foliage(random, size.x() * size.y() * size.z(), 5.0, 0.11,
                             [&] {
                                 const double x = random.uniform(extent.low.x(), extent.high.x());
                                 const double y = random.uniform(extent.low.y(), extent.high.y());
                                 const double z = random.uniform(extent.low.z(), extent.high.z());
                                 return Eigen::Vector3d(x, y, z);
                             }),
                     at);
}

}  // namespace gnomon::simulation::detail
