// SPDX-License-Identifier: BSL-1.0
/// @file
/// A rectangle.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/polyhedron.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// A two-sided rectangle in the plane z = 0 about the origin of its frame. Its borders are extended
/// by a billionth of its size, so that no ray passes between adjacent walls.
struct plane_patch {
    double length;  ///< along x [m]
    double width;   ///< along y [m]

    [[nodiscard]] bounds extent() const {
        return {{-0.5 * length, -0.5 * width, 0.0}, {0.5 * length, 0.5 * width, 0.0}};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 1> names{"plane"};
        return names;
    }

    [[nodiscard]] polyhedron triangles() const {
        const double x = 0.5 * length;
        const double y = 0.5 * width;
        return {{{-x, -y, 0.0}, {x, -y, 0.0}, {x, y, 0.0}, {-x, y, 0.0}},
                {{0, 1, 2}, {0, 2, 3}},
                {0, 0}};
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        const double range = -r.origin.z() / r.direction.z();
        if (!(range > 0.0 && range <= r.reach)) return std::nullopt;
        const double margin = 1e-9 * (length + width);
        const bool hit =
            std::abs(r.origin.x() + range * r.direction.x()) <= 0.5 * length + margin &&
            std::abs(r.origin.y() + range * r.direction.y()) <= 0.5 * width + margin;
        if (!hit) return std::nullopt;
        return ray_hit{range, {0.0, 0.0, r.direction.z() > 0.0 ? -1.0 : 1.0}, 0};
    }
};

}  // namespace gnomon::simulation
