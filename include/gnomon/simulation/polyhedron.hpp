// SPDX-License-Identifier: BSL-1.0
/// @file
/// Triangles with surface numbers: the exact representation of a shape with planar faces, and the
/// input of triangle ray casters.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace gnomon::simulation {

/// The indices of three vertices, in either orientation.
using triangle = std::array<std::uint32_t, 3>;

/// Triangles and, for each of them, the number of its surface.
struct polyhedron {
    std::vector<Eigen::Vector3d> vertices;          ///< [m]
    std::vector<triangle> triangles;                ///< its surface
    std::vector<std::int32_t> surface_of_triangle;  ///< one per triangle; empty: all are surface 0
};

namespace detail {

/// A shape with planar faces: s.triangles() is the same surface with the same surface numbers.
template <class S>
concept flat_shape = requires(const S& s) {
    { s.triangles() } -> std::convertible_to<polyhedron>;
};

}  // namespace detail

}  // namespace gnomon::simulation
