// SPDX-License-Identifier: BSL-1.0
/// @file
/// A wall with rectangular holes.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/bounds.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>

namespace gnomon::simulation::detail {

/// A rectangle of a wall, in the frame of its patch.
struct wall_rectangle {
    double left, right;  ///< x [m]
    double low, high;    ///< y [m]

    [[nodiscard]] double width() const { return right - left; }
    [[nodiscard]] double height() const { return high - low; }
    /// Whether a point is inside, not on the edge.
    [[nodiscard]] bool contains(double x, double y) const {
        return x > left && x < right && y > low && y < high;
    }
    /// Whether the rectangles are less than `margin` apart.
    [[nodiscard]] bool is_near(const wall_rectangle& o, double margin) const {
        return left < o.right + margin && o.left < right + margin && low < o.high + margin &&
               o.low < high + margin;
    }
};

/// A patch with holes, one surface. Precondition: the holes are within the patch.
struct wall {
    plane_patch patch;
    std::vector<wall_rectangle> holes;

    [[nodiscard]] bounds extent() const { return patch.extent(); }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        return plane_patch::surface_names();
    }

    /// The cells between all edges of holes that are in no hole.
    [[nodiscard]] polyhedron triangles() const {
        std::vector<double> xs{-0.5 * patch.length, 0.5 * patch.length};
        std::vector<double> ys{-0.5 * patch.width, 0.5 * patch.width};
        for (const wall_rectangle& hole : holes) {
            xs.insert(xs.end(), {hole.left, hole.right});
            ys.insert(ys.end(), {hole.low, hole.high});
        }
        for (auto* values : {&xs, &ys}) {
            std::sort(values->begin(), values->end());
            values->erase(std::unique(values->begin(), values->end()), values->end());
        }
        polyhedron result;
        for (const double y : ys)
            for (const double x : xs) result.vertices.push_back({x, y, 0.0});
        const auto vertex = [&](std::size_t i, std::size_t j) {
            return static_cast<std::uint32_t>(j * xs.size() + i);
        };
        for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
            for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
                if (is_in_hole(0.5 * (xs[i] + xs[i + 1]), 0.5 * (ys[j] + ys[j + 1]))) continue;
                result.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
                result.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
            }
        }
        result.surface_of_triangle.assign(result.triangles.size(), 0);
        return result;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        const auto hit = patch.first_hit(r);
        if (hit && is_in_hole(r.origin.x() + hit->range * r.direction.x(),
                              r.origin.y() + hit->range * r.direction.y()))
            return std::nullopt;
        return hit;
    }

  private:
    [[nodiscard]] bool is_in_hole(double x, double y) const {
        return std::any_of(holes.begin(), holes.end(),
                           [&](const wall_rectangle& hole) { return hole.contains(x, y); });
    }
};

}  // namespace gnomon::simulation::detail
