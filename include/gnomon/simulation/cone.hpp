// SPDX-License-Identifier: BSL-1.0
/// @file
/// A closed cone.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include <gnomon/simulation/detail/revolved_arc.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// A closed cone about the z axis with its base at z = 0 and its apex above. Surfaces: 0 the
/// mantle, 1 the bottom. With height 0 it is a disc.
struct cone {
    double radius;  ///< at the bottom [m]
    double height;  ///< of the apex [m]

    [[nodiscard]] bounds extent() const {
        return {{-radius, -radius, 0.0}, {radius, radius, height}};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 2> names{"mantle", "bottom"};
        return names;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        // radius(z) = s (height - z)
        const double s = radius / height;
        const detail::revolved_arc mantle{0.0, height, s * s, -2.0 * s * radius, radius * radius};
        return detail::first_hit_of({&mantle, 1}, {.bottom = radius * radius, .top = {}}, r);
    }
};

}  // namespace gnomon::simulation
