// SPDX-License-Identifier: BSL-1.0
/// @file
/// Triangle meshes, such as CAD models and scanned rooms.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/detail/bvh.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

namespace detail {

/// A watertight ray-triangle intersection (Woop, Benthin and Wald 2013): the ray is sheared onto a
/// coordinate axis, and both triangles of a shared edge use the same arithmetic, so that no ray
/// passes between them.
class triangle_probe {
  public:
    explicit triangle_probe(const ray& r) : origin_(r.origin) {
        for (int a = 1; a < 3; ++a) {
            if (std::abs(r.direction[a]) > std::abs(r.direction[z_])) z_ = a;
        }
        x_ = (z_ + 1) % 3;
        y_ = (z_ + 2) % 3;
        shear_x_ = r.direction[x_] / r.direction[z_];
        shear_y_ = r.direction[y_] / r.direction[z_];
        scale_ = 1.0 / r.direction[z_];
    }

    /// The range at which the ray meets the triangle, from either side; NaN or not positive if
    /// there is no intersection.
    [[nodiscard]] double range(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const Eigen::Vector3d& c) const {
        const Eigen::Vector3d p = sheared(a);
        const Eigen::Vector3d q = sheared(b);
        const Eigen::Vector3d s = sheared(c);
        const double u = turn(s, q);
        const double v = turn(p, s);
        const double w = turn(q, p);
        if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) return -1.0;
        return (u * p.z() + v * q.z() + w * s.z()) / (u + v + w);
    }

  private:
    /// The signed area that p and q span in the plane normal to the ray. It is exactly -turn(q, p):
    /// the explicit fma keeps compilers from contracting only one of the two products.
    [[nodiscard]] static double turn(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
#if defined(FP_FAST_FMA) || defined(__FMA__) || defined(__ARM_FEATURE_FMA)
        return std::fma(p.x(), q.y(), -(p.y() * q.x())) - std::fma(q.x(), p.y(), -(q.y() * p.x()));
#else
        return p.x() * q.y() - p.y() * q.x();
#endif
    }

    /// `vertex` in the sheared frame: the ray is the third axis, and z is the range.
    [[nodiscard]] Eigen::Vector3d sheared(const Eigen::Vector3d& vertex) const {
        const Eigen::Vector3d d = vertex - origin_;
        return {d[x_] - shear_x_ * d[z_], d[y_] - shear_y_ * d[z_], scale_ * d[z_]};
    }

    Eigen::Vector3d origin_;
    int x_;
    int y_;
    int z_ = 0;  // the axis along which the ray runs fastest
    double shear_x_;
    double shear_y_;
    double scale_;
};

}  // namespace detail

/// A triangle mesh of one or more surfaces. Copies share the triangles.
class triangle_mesh {
  public:
    /// Degenerate triangles are allowed; no ray meets them. O(n log n).
    /// @param surface_names  one per surface number
    /// @throws std::invalid_argument  if there are no triangles, a vertex is not finite, a triangle
    ///                                refers to a missing vertex, or the surface numbers do not fit
    ///                                triangles and names
    explicit triangle_mesh(polyhedron faces, std::vector<std::string> surface_names = {"mesh"})
        : content_(std::make_shared<const content>(std::move(faces), std::move(surface_names))) {}

    [[nodiscard]] const polyhedron& triangles() const { return content_->faces; }

    [[nodiscard]] bounds extent() const { return content_->extent; }
    [[nodiscard]] const std::vector<std::string>& surface_names() const {
        return content_->surface_names;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& given) const {
        const detail::triangle_probe probe(given);
        const std::vector<Eigen::Vector3d>& v = content_->faces.vertices;
        ray r = given;
        std::optional<ray_hit> hit;
        content_->tree.walk(r, [&](std::uint32_t t) {
            const auto [a, b, c] = content_->faces.triangles[t];
            const double range = probe.range(v[a], v[b], v[c]);
            if (!(range > 0.0 && range <= r.reach)) return;
            const Eigen::Vector3d n = cross(v[b] - v[a], v[c] - v[a]);
            const double length = std::sqrt(n.dot(n));
            // `length` is twice the area: the longest side times the triangle's width. The rounding
            // of the width grows with the range; on a thinner triangle the range would be
            // arbitrary.
            const double longest =
                std::sqrt(std::max({squared_distance(v[a], v[b]), squared_distance(v[b], v[c]),
                                    squared_distance(v[c], v[a])}));
            if (!(length > 1e-15 * longest * (longest + range))) return;
            const double sign = n.dot(r.direction) > 0.0 ? -1.0 : 1.0;
            hit = ray_hit{range, n * (sign / length), content_->surface_of(t)};
            r.reach = range;
        });
        return hit;
    }

  private:
    struct content {
        polyhedron faces;
        std::vector<std::string> surface_names;
        bounds extent;
        detail::bvh tree;

        content(polyhedron given, std::vector<std::string> names)
            : faces(std::move(given)), surface_names(std::move(names)) {
            using gnomon::detail::require;
            const auto& [vertices, triangles, surfaces] = faces;
            require(!triangles.empty(), "triangle_mesh: there are no triangles");
            require(surfaces.empty() || surfaces.size() == triangles.size(),
                    "triangle_mesh: surfaces for another number of triangles");
            for (std::size_t t = 0; t < triangles.size(); ++t) {
                const std::int32_t surface = surface_of(t);
                require(surface >= 0 && static_cast<std::size_t>(surface) < surface_names.size(),
                        "triangle_mesh: a triangle of a surface without name");
            }
            for (const Eigen::Vector3d& v : vertices)
                require(is_finite(v), "triangle_mesh: a vertex is not finite");
            std::vector<bounds> boxes;
            boxes.reserve(triangles.size());
            for (const triangle& t : triangles) {
                bounds box;
                for (const std::uint32_t i : t) {
                    require(i < vertices.size(), "triangle_mesh: a triangle of a missing vertex");
                    box.extend(vertices[i]);
                }
                extent.extend(box);
                boxes.push_back(box);
            }
            // A margin for the rounding of ranges: a ray may enter a flat box behind its hit.
            double largest = 0.0;
            for (int a = 0; a < 3; ++a) {
                largest = std::max({largest, std::abs(extent.low[a]), std::abs(extent.high[a])});
            }
            const Eigen::Vector3d margin = Eigen::Vector3d::Constant(1e-14 * largest);
            for (bounds& box : boxes) box = {box.low - margin, box.high + margin};
            tree = detail::bvh(boxes);
        }

        [[nodiscard]] std::int32_t surface_of(std::size_t t) const {
            return faces.surface_of_triangle.empty() ? 0 : faces.surface_of_triangle[t];
        }
    };

    [[nodiscard]] static Eigen::Vector3d cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
        return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(),
                a.x() * b.y() - a.y() * b.x()};
    }

    std::shared_ptr<const content> content_;
};

}  // namespace gnomon::simulation
