// SPDX-License-Identifier: BSL-1.0
/// @file
/// Triangles: what CAD models and scanned rooms are made of.
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

namespace gnomon {

namespace detail {

/// A ray, sheared so that it runs along an axis of its own; the same arithmetic on an edge for both
/// triangles that share it, so that no ray slips through between them (Woop, Benthin and Wald
/// 2013).
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

    /// The range at which the ray meets the triangle, from either side; NaN or not positive if it
    /// does not.
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
    /// Which way, seen along the ray, lies the edge from p to q? Exactly -turn(q, p): compilers may
    /// fuse either product with the difference, but not if they are told which.
    [[nodiscard]] static double turn(const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
#if defined(FP_FAST_FMA) || defined(__FMA__) || defined(__ARM_FEATURE_FMA)
        return std::fma(p.x(), q.y(), -(p.y() * q.x())) - std::fma(q.x(), p.y(), -(q.y() * p.x()));
#else
        return p.x() * q.y() - p.y() * q.x();
#endif
    }

    /// `vertex` in the frame in which the ray is the third axis, and z its range.
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

/// A mesh of one or more surfaces. Copies share the triangles.
class triangle_mesh {
  public:
    /// Triangles may be there that are as thin as rounding, or thinner; no ray meets them.
    /// O(n log n).
    /// @param surface_names  one for each number of a surface
    /// @throws std::invalid_argument  without triangles; for a vertex that is not finite; for a
    ///                                triangle of a missing vertex; if the numbers of surfaces do
    ///                                not fit triangles and names
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
            // Twice its area is the longest side times the width, whose rounding grows with the
            // range: the range of a hit on a thinner triangle would be anything.
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
            using detail::require;
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
            // The range of a hit carries rounding, so a flat box may be entered behind it.
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

}  // namespace gnomon
