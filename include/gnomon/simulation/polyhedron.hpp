// SPDX-License-Identifier: BSL-1.0
/// @file
/// Flat faces, as triangles: what shapes without a curve are exactly, and what ray casters for
/// triangles want to have.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gnomon {

/// Three vertices by number, in either sense of rotation.
using triangle = std::array<std::uint32_t, 3>;

/// Triangles and the number of the surface that each belongs to.
struct polyhedron {
    std::vector<Eigen::Vector3d> vertices;  ///< [m]
    std::vector<triangle> triangles;
    std::vector<std::int32_t> surface_of_triangle;  ///< one for each, or none: all are surface 0
};

/// A shape that can say so: s.triangles() is the same surface, numbered alike.
template <class S>
concept flat_shape = requires(const S& s) {
    { s.triangles() } -> std::convertible_to<polyhedron>;
};

}  // namespace gnomon
