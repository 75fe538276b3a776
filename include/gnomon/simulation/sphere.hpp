// SPDX-License-Identifier: BSL-1.0
/// @file
/// A sphere.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include <Eigen/Core>

#include <gnomon/simulation/detail/revolved_arc.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/shape.hpp>

namespace gnomon::simulation {

/// A sphere about the origin of its frame; one surface.
struct sphere {
    double radius;  ///< [m]

    [[nodiscard]] bounds extent() const {
        return {Eigen::Vector3d::Constant(-radius), Eigen::Vector3d::Constant(radius)};
    }

    [[nodiscard]] static std::span<const std::string_view> surface_names() {
        static constexpr std::array<std::string_view, 1> names{"sphere"};
        return names;
    }

    [[nodiscard]] std::optional<ray_hit> first_hit(const ray& r) const {
        const detail::revolved_arc all{-radius, radius, -1.0, 0.0, radius * radius};
        return detail::first_hit_of({&all, 1}, {}, r);
    }
};

}  // namespace gnomon::simulation
