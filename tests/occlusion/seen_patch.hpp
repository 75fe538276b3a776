// SPDX-License-Identifier: BSL-1.0
/// @file
/// Rectangles as a sensor in the origin sees them, for the tests of their planes.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "laws/clouds.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>

namespace seen {

inline constexpr double sigma = 0.015;

/// A rectangle that rays from the origin meet, with noise along them.
struct patch {
    Eigen::Vector3d center, side, other_side;
    int rays = 10;  ///< in each direction

    [[nodiscard]] clouds::cloud points(std::uint64_t seed) const {
        gnomon::random_stream random(seed);
        clouds::cloud result;
        for (int i = 0; i < rays; ++i) {
            for (int j = 0; j < rays; ++j) {
                const double a = (i + 0.5) / rays - 0.5, b = (j + 0.5) / rays - 0.5;
                const Eigen::Vector3d p = center + a * side + b * other_side;
                result.push_back(p * (1.0 + sigma * random.gaussian() / p.norm()));
            }
        }
        return result;
    }
};

inline gnomon::detail::plane_sample sample_of(const clouds::cloud& points) {
    const Eigen::Vector3d viewpoint(0.0, 0.0, 0.0);
    return gnomon::detail::plane_sample_of(points, gnomon::detail::moments_about_first(points),
                                           viewpoint, sigma);
}

/// A seat 1.5 m away and 80 cm below the eye.
inline const patch seat{{1.5, 0.0, -0.8}, {0.4, 0, 0}, {0, 0.4, 0}};

}  // namespace seen
