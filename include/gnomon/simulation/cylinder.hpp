// SPDX-License-Identifier: BSL-1.0
/// @file
/// A closed cylinder.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include <gnomon/simulation/detail/revolved_arc.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// A closed cylinder about the z axis with its base at z = 0. Surfaces: 0 the mantle, 1 the bottom,
/// 2 the top.
struct cylinder {
    double radius;  ///< [m]
    double height;  ///< [m]

    [[nodiscard]] bounds extent() const {
        return {{-radius, -radius, 0.0}, {radius, radius, height}};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 3> names{"mantle", "bottom", "top"};
        return names;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        const detail::revolved_arc mantle{0.0, height, 0.0, 0.0, radius * radius};
        return detail::first_hit_of({&mantle, 1},
                                    {.bottom = radius * radius, .top = radius * radius}, r);
    }
};

}  // namespace gnomon::simulation
