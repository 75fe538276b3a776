// SPDX-License-Identifier: BSL-1.0
/// @file
/// The surface of a mesh file, where Assimp reads it.
#pragma once

#include <optional>
#include <string>

#include "sampling.hpp"

#ifdef GNOMON_BENCHMARKS_ASSIMP
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <gnomon/adapters/assimp_scene.hpp>
#include <gnomon/core/error.hpp>
#endif

namespace known_normals {

#ifdef GNOMON_BENCHMARKS_ASSIMP
namespace sim = gnomon::simulation;
#endif

/// All triangles of the file, brought to about the size of the other shapes, since some estimators
/// have parameters in metres: by a power of two, which rounds nothing. Nothing if the file, or
/// Assimp, is missing.
inline std::optional<surface> mesh_surface([[maybe_unused]] const std::string& path) {
#ifdef GNOMON_BENCHMARKS_ASSIMP
    std::vector<Vector3d> corners;  // three for each triangle
    sim::bounds extent;
    try {
        const sim::scene file = sim::read_scene(path, sim::mesh_groups::parts);
        extent = file.extent();
        for (const sim::placed_shape& s : file.shapes()) {
            const sim::polyhedron faces = s.shape->triangles().value();
            for (const sim::triangle& t : faces.triangles)
                for (const auto vertex : t) corners.push_back(faces.vertices[vertex]);
        }
    } catch (const gnomon::error&) {
        return std::nullopt;
    }
    const double scale = std::exp2(std::round(std::log2(3.0 / (extent.high - extent.low).norm())));
    std::vector<Vector3d> normals;  // of twice the triangle's area
    std::vector<double> sums;
    double total = 0.0;
    for (Vector3d& c : corners) c *= scale;
    for (std::size_t t = 0; t < corners.size(); t += 3) {
        normals.push_back((corners[t + 1] - corners[t]).cross(corners[t + 2] - corners[t]));
        sums.push_back(total += normals.back().norm());
    }
    return [corners = std::move(corners), normals = std::move(normals), sums = std::move(sums),
            total](dice& d) {
        const auto found = std::upper_bound(sums.begin(), sums.end() - 1, d.uniform(0.0, total));
        const auto t = static_cast<std::size_t>(found - sums.begin());
        const double r = std::sqrt(d.uniform());
        const double v = d.uniform();
        return surface_point{(1.0 - r) * corners[3 * t] + r * (1.0 - v) * corners[3 * t + 1] +
                                 r * v * corners[3 * t + 2],
                             normals[t].normalized()};
    };
#else
    return std::nullopt;
#endif
}

}  // namespace known_normals
