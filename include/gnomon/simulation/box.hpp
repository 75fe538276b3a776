// SPDX-License-Identifier: BSL-1.0
/// @file
/// A box. Furniture is made of boxes; seen from inside, a box is a room.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string_view>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// An axis-aligned box about the origin of its frame. Surfaces: 0 to 5 for +x, -x, +y, -y, +z, -z.
/// The box is enlarged by a billionth of its size for rays that miss it, so that no ray passes
/// between adjacent boxes. A ray within the plane of a side counts as inside.
struct box {
    double length;  ///< along x [m]
    double width;   ///< along y [m]
    double height;  ///< along z [m]

    [[nodiscard]] bounds extent() const {
        return {{-0.5 * length, -0.5 * width, -0.5 * height},
                {0.5 * length, 0.5 * width, 0.5 * height}};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 6> names{"+x", "-x", "+y", "-y", "+z", "-z"};
        return names;
    }

    [[nodiscard]] polyhedron triangles() const {
        polyhedron result;
        for (int i = 0; i < 8; ++i) {  // bit a of a vertex: on the positive side of axis a
            result.vertices.push_back({(i & 1 ? 0.5 : -0.5) * length, (i & 2 ? 0.5 : -0.5) * width,
                                       (i & 4 ? 0.5 : -0.5) * height});
        }
        for (std::uint32_t axis = 0; axis < 3; ++axis) {
            const std::uint32_t u = 1u << ((axis + 1) % 3);
            const std::uint32_t v = 1u << ((axis + 2) % 3);
            for (const std::uint32_t side : {1u << axis, 0u}) {
                result.triangles.push_back({side, side | u, side | u | v});
                result.triangles.push_back({side, side | u | v, side | v});
                const auto surface = static_cast<std::int32_t>(2 * axis + (side == 0 ? 1 : 0));
                result.surface_of_triangle.insert(result.surface_of_triangle.end(), 2, surface);
            }
        }
        return result;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        auto inner = overlap(r, 0.0);
        const bool passes = !inner;
        if (passes) inner = overlap(r, 1e-9 * (length + width + height));
        if (!inner) return std::nullopt;
        const auto [enter, leave, entered, left] = *inner;
        const bool inside = enter <= 0.0;
        if (inside && passes) return std::nullopt;
        const double range = inside ? leave : enter;
        if (!(range > 0.0 && range <= r.reach && range < std::numeric_limits<double>::infinity()))
            return std::nullopt;

        const int axis = inside ? left : entered;
        const bool towards_positive = r.direction[axis] > 0.0;
        Eigen::Vector3d normal(0.0, 0.0, 0.0);
        normal[axis] = towards_positive ? -1.0 : 1.0;
        return ray_hit{range, normal, 2 * axis + (towards_positive == inside ? 0 : 1)};
    }

  private:
    /// The interval of ranges in which a ray lies between all three pairs of parallel planes.
    struct interval {
        double enter;
        double leave;
        int entered;  ///< axis of the planes entered last
        int left;     ///< axis of the planes left first
    };

    /// The slab method (Kay and Kajiya 1986).
    [[nodiscard]] std::optional<interval> overlap(const ray& r, double margin) const {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const std::array<double, 3> size{length, width, height};
        interval result{-infinity, infinity, 0, 0};
        for (int axis = 0; axis < 3; ++axis) {
            const double o = r.origin[axis];
            const double u = r.direction[axis];
            const double half = 0.5 * size[static_cast<std::size_t>(axis)] + margin;
            if (u == 0.0) {
                if (!(std::abs(o) <= half)) return std::nullopt;
                continue;
            }
            double in = (-half - o) / u;
            double out = (half - o) / u;
            if (in > out) std::swap(in, out);
            if (!(in <= result.leave && out >= result.enter)) return std::nullopt;
            if (in > result.enter) {
                result.enter = in;
                result.entered = axis;
            }
            if (out < result.leave) {
                result.leave = out;
                result.left = axis;
            }
        }
        return result;
    }
};

}  // namespace gnomon::simulation
