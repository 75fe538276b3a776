// SPDX-License-Identifier: BSL-1.0
/// @file
/// The height profile of points above the ground: how many there are at each height, and how far
/// they extend there. Profiles of parts add up to that of their union, so that a view without some
/// of its parts is described without its points.
#pragma once

#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon::recognition {

/// Number, and first and second moments of the horizontal position, of the points of each level of
/// height above the ground.
struct height_profile {
    /// The points of a level.
    struct level {
        double points = 0.0;                  ///< their number
        double u = 0.0, v = 0.0;              ///< sums of the horizontal coordinates [m]
        double uu = 0.0, uv = 0.0, vv = 0.0;  ///< sums of their products [m^2]

        /// Adds the points of another level.
        level& operator+=(const level& o) {
            points += o.points;
            u += o.u;
            v += o.v;
            uu += o.uu;
            uv += o.uv;
            vv += o.vv;
            return *this;
        }
    };

    static constexpr double thickness = 0.05;  ///< of a level [m]
    /// Those below 2.4 m. The lowest one is left empty, as crop_height() removes it with the floor;
    /// the highest one holds everything above, too.
    static constexpr std::size_t count = 48;

    std::array<level, count> levels{};  ///< from the ground upwards

    /// Adds a point. Not counted below the second level.
    /// @param height  above the ground [m], finite
    /// @param u, v    horizontal coordinates about an origin near the points [m]
    void add(double height, double u, double v) {
        if (!(height >= thickness)) return;
        const double at = std::floor(height / thickness);
        const std::size_t i =
            at < static_cast<double>(count) ? static_cast<std::size_t>(at) : count - 1;
        levels[i] += {1.0, u, v, u * u, u * v, v * v};
    }

    /// Adds the points of another profile, about the same origin.
    height_profile& operator+=(const height_profile& other) {
        for (std::size_t i = 0; i < count; ++i) levels[i] += other.levels[i];
        return *this;
    }

    /// The points of all levels from the first to before the last.
    [[nodiscard]] level band(std::size_t first, std::size_t last) const {
        level sum;
        for (std::size_t i = first; i < last; ++i) sum += levels[i];
        return sum;
    }
};

namespace detail {

/// The standard deviations [m] of the horizontal positions along their principal axes, the larger
/// one first; zero of less than three points.
[[nodiscard]] inline std::array<double, 2> horizontal_extent(const height_profile::level& l) {
    constexpr double fewest = 3.0;  // formula: two points have no extent across their line
    if (l.points < fewest) return {0.0, 0.0};
    const double u = l.u / l.points, v = l.v / l.points;
    const double uu = l.uu / l.points - u * u, uv = l.uv / l.points - u * v,
                 vv = l.vv / l.points - v * v;
    const double mean = 0.5 * (uu + vv), half = std::hypot(0.5 * (uu - vv), uv);
    return {std::sqrt(std::max(0.0, mean + half)), std::sqrt(std::max(0.0, mean - half))};
}

}  // namespace detail
}  // namespace gnomon::recognition
