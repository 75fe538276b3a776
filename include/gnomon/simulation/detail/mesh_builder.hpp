// SPDX-License-Identifier: BSL-1.0
/// @file
/// A builder of triangle meshes from convex planar faces, each face on a named surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/triangle_mesh.hpp>

namespace gnomon::simulation::detail {

/// Collects faces. Faces share no vertices; faces whose edges have equal ends are watertight.
class mesh_builder {
  public:
    /// Begins a new surface, to which the following faces belong.
    mesh_builder& surface(std::string name) {
        names_.push_back(std::move(name));
        return *this;
    }

    /// Adds a convex planar polygon of three or more corners [m]. Precondition: a surface was
    /// begun.
    mesh_builder& face(std::span<const Eigen::Vector3d> corners) {
        const auto first = static_cast<std::uint32_t>(faces_.vertices.size());
        faces_.vertices.insert(faces_.vertices.end(), corners.begin(), corners.end());
        for (std::uint32_t i = 2; i < corners.size(); ++i) {
            faces_.triangles.push_back({first, first + i - 1, first + i});
            faces_.surface_of_triangle.push_back(static_cast<std::int32_t>(names_.size() - 1));
        }
        return *this;
    }
    mesh_builder& face(std::initializer_list<Eigen::Vector3d> corners) {
        return face(std::span(corners.begin(), corners.size()));
    }

    /// @throws std::invalid_argument  as triangle_mesh does
    [[nodiscard]] triangle_mesh mesh() const { return triangle_mesh(faces_, names_); }

  private:
    polyhedron faces_;
    std::vector<std::string> names_;
};

/// A corner of a side view, on both sides of the plane y = 0.
struct profile_corner {
    double x;           ///< [m]
    double z;           ///< [m]
    double half_width;  ///< distance from the plane y = 0 [m]
};

/// A solid that is symmetric about y = 0, from a convex side view whose half widths are linear in x
/// and z: one surface from each corner to the next one, by the given names, then "left" and
/// "right".
[[nodiscard]] inline triangle_mesh symmetric_solid(std::span<const profile_corner> profile,
                                                   std::span<const char* const> names) {
    std::vector<Eigen::Vector3d> left, right;
    for (const profile_corner& c : profile) {
        left.push_back({c.x, c.half_width, c.z});
        right.push_back({c.x, -c.half_width, c.z});
    }
    mesh_builder b;
    for (std::size_t i = 0; i < profile.size(); ++i) {
        const std::size_t next = (i + 1) % profile.size();
        b.surface(names[i]).face({left[i], left[next], right[next], right[i]});
    }
    return b.surface("left").face(left).surface("right").face(right).mesh();
}

}  // namespace gnomon::simulation::detail
