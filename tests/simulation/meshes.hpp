// SPDX-License-Identifier: BSL-1.0
/// @file
/// Solids of triangles, to hold against their exact counterparts.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/cylinder.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace meshes {

namespace sim = gnomon::simulation;

/// Surfaces numbered as those of the box.
inline sim::triangle_mesh of_box(const sim::box& b) {
    return sim::triangle_mesh(b.triangles(), {"+x", "-x", "+y", "-y", "+z", "-z"});
}

/// A prism with `sides` sides; surfaces have the numbers of those of the cylinder.
inline sim::triangle_mesh of_cylinder(const sim::cylinder& c, std::uint32_t sides) {
    std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {0, 0, c.height}};
    std::vector<sim::triangle> triangles;
    std::vector<std::int32_t> surfaces;
    for (std::uint32_t i = 0; i < sides; ++i) {
        const double a = 2 * std::numbers::pi * i / sides;
        for (const double z : {0.0, c.height})
            vertices.push_back({c.radius * std::cos(a), c.radius * std::sin(a), z});
        const std::uint32_t low = 2 + 2 * i;
        const std::uint32_t next = 2 + 2 * ((i + 1) % sides);
        triangles.push_back({low, next, next + 1});
        triangles.push_back({low, next + 1, low + 1});
        triangles.push_back({0, next, low});
        triangles.push_back({1, low + 1, next + 1});
        surfaces.insert(surfaces.end(), {0, 0, 1, 2});
    }
    return sim::triangle_mesh({vertices, triangles, surfaces}, {"mantle", "bottom", "top"});
}

}  // namespace meshes
