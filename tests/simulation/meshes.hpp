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

/// Surfaces numbered as those of the box.
inline gnomon::triangle_mesh of_box(const gnomon::box& b) {
    std::vector<Eigen::Vector3d> vertices;
    for (int i = 0; i < 8; ++i) {
        vertices.push_back({(i & 1 ? 0.5 : -0.5) * b.length, (i & 2 ? 0.5 : -0.5) * b.width,
                            (i & 4 ? 0.5 : -0.5) * b.height});
    }
    std::vector<gnomon::triangle> triangles;
    std::vector<std::int32_t> surfaces;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        for (const std::uint32_t side : {1u, 0u}) {
            const std::uint32_t own = side << axis;
            const std::uint32_t u = 1u << ((axis + 1) % 3);
            const std::uint32_t v = 1u << ((axis + 2) % 3);
            triangles.push_back({own, own | u, own | u | v});
            triangles.push_back({own, own | u | v, own | v});
            surfaces.insert(surfaces.end(), 2, static_cast<std::int32_t>(2 * axis + (1 - side)));
        }
    }
    return {vertices, triangles, surfaces, {"+x", "-x", "+y", "-y", "+z", "-z"}};
}

/// Of so many sides; surfaces numbered as those of the cylinder.
inline gnomon::triangle_mesh of_cylinder(const gnomon::cylinder& c, std::uint32_t sides) {
    std::vector<Eigen::Vector3d> vertices{{0, 0, 0}, {0, 0, c.height}};
    std::vector<gnomon::triangle> triangles;
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
    return {vertices, triangles, surfaces, {"mantle", "bottom", "top"}};
}

}  // namespace meshes
