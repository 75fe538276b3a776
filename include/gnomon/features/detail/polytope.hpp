// SPDX-License-Identifier: BSL-1.0
/// @file
/// A convex polyhedron as a graph: the corners that are adjacent to a corner, and the directions in
/// which an edge is the farthest.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/hull_simplex.hpp>
#include <gnomon/features/detail/quickhull.hpp>

namespace gnomon::detail {

/// An edge, and unit vectors at the ends of an arc of outward normals of supporting planes through
/// it: those of the facets at the edge. The arc is at most about a quarter turn.
struct edge_arc {
    std::uint32_t corner;       ///< an end of the edge
    Eigen::Vector3d direction;  ///< of the edge, a unit vector
    Eigen::Vector3d first;
    Eigen::Vector3d last;
};

class polytope {
  public:
    /// The hull of at least four points with coordinates up to 1 in magnitude. Without arcs if the
    /// points are coplanar.
    explicit polytope(std::span<const Eigen::Vector3d> points)
        : points_(points), first_neighbor_(points.size() + 1, 0) {
        const hull_simplex simplex(points);
        if (simplex.count < 4) return;
        std::vector<hull_triangle> triangles;
        quickhull(points, simplex.corners).for_each_triangle([&](const hull_triangle& t) {
            triangles.push_back(t);
            for (const std::uint32_t corner : t) ++first_neighbor_[corner + 1];
        });
        for (std::size_t p = 0; p < points.size(); ++p)
            first_neighbor_[p + 1] += first_neighbor_[p];
        neighbors_.resize(3 * triangles.size());
        left_.resize(neighbors_.size());
        std::vector<std::uint32_t> end(first_neighbor_.begin(), first_neighbor_.end() - 1);
        for (const hull_triangle& t : triangles) {
            const Eigen::Vector3d& a = points[t[0]];
            const Eigen::Vector3d normal =
                cross(difference(points[t[1]], a), difference(points[t[2]], a));
            for (std::size_t i = 0; i < 3; ++i) {
                left_[end[t[i]]] = normal;
                neighbors_[end[t[i]]++] = t[(i + 1) % 3];
            }
        }
        start_ = triangles.front()[0];
        make_arcs();
    }

    [[nodiscard]] const std::vector<edge_arc>& arcs() const { return arcs_; }
    [[nodiscard]] const Eigen::Vector3d& operator[](std::uint32_t corner) const {
        return points_[corner];
    }
    /// Any corner.
    [[nodiscard]] std::uint32_t start() const { return start_; }

    /// A corner that is farthest in a direction: uphill from `corner`.
    [[nodiscard]] std::uint32_t farthest(const Eigen::Vector3d& direction,
                                         std::uint32_t corner) const {
        double height = dot(direction, points_[corner]);
        for (bool climbs = true; climbs;) {
            climbs = false;
            const std::uint32_t from = corner;
            for (std::uint32_t n = first_neighbor_[from]; n < first_neighbor_[from + 1]; ++n) {
                const double h = dot(direction, points_[neighbors_[n]]);
                if (!(h > height)) continue;
                height = h;
                corner = neighbors_[n];
                climbs = true;
            }
        }
        return corner;
    }

  private:
    void make_arcs() {
        for (std::uint32_t p = 0; p + 1 < first_neighbor_.size(); ++p) {
            for (std::uint32_t n = first_neighbor_[p]; n < first_neighbor_[p + 1]; ++n) {
                const std::uint32_t q = neighbors_[n];
                if (q < p) continue;
                std::uint32_t back = first_neighbor_[q];
                while (neighbors_[back] != p) ++back;
                const Eigen::Vector3d edge = difference(points_[q], points_[p]);
                if (has_length(left_[n]) && has_length(left_[back]) && has_length(edge))
                    add_arc(
                        {p, direction_of(edge), direction_of(left_[n]), direction_of(left_[back])});
            }
        }
    }

    void add_arc(const edge_arc& arc) {
        constexpr double flat = 1e-12;  // [rad]: rounding; the facets' other edges have that normal
        if (length(difference(arc.first, arc.last)) < flat) return;
        constexpr double wide = -0.1;  // numerical: the middle of the chord is far from zero
        if (dot(arc.first, arc.last) > wide) {
            arcs_.push_back(arc);
            return;
        }
        const Eigen::Vector3d middle = direction_of(
            difference(cross(arc.direction, arc.first), cross(arc.direction, arc.last)));
        arcs_.push_back({arc.corner, arc.direction, arc.first, middle});
        arcs_.push_back({arc.corner, arc.direction, middle, arc.last});
    }

    std::span<const Eigen::Vector3d> points_;
    std::vector<std::uint32_t> first_neighbor_;
    std::vector<std::uint32_t> neighbors_;
    std::vector<Eigen::Vector3d>
        left_;  // the normal of the triangle left of the edge to a neighbor
    std::vector<edge_arc> arcs_;
    std::uint32_t start_ = 0;
};

}  // namespace gnomon::detail
