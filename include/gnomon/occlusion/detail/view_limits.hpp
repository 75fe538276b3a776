// SPDX-License-Identifier: BSL-1.0
/// @file
/// The field of view of a scan: between the lowest and the highest elevation with returns. What is
/// below the lowest beam of a lidar was not observed, so it does not separate surfaces. The limits
/// differ by azimuth where the sensor is tilted about the pole, or not quite at its view point.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/occlusion/detail/image_axes.hpp>

namespace gnomon::detail {

/// The limits in each of some sectors of azimuth.
struct view_limits {
    /// Those of rays, enlarged by two pixels.
    /// @param ways   the rays, of any length but 0 [m]
    /// @param pole   the axis of elevation, of any length
    /// @param pixel  [rad]
    void set(const auto& ways, const auto& pole, double pixel) {
        axes_ = image_axes::with_pole(pole);
        all_ = {};
        for (limits& sector : sectors_) sector = {};
        for (const Eigen::Vector3d& way : ways) {
            const double sine = dot(axes_.z, way) / length(way);
            sectors_[sector_of(way)].add({sine, sine});
            all_.add({sine, sine});
        }
        for (limits& sector : sectors_) sector.enlarge(2.0 * pixel);
        all_.enlarge(2.0 * pixel);
    }

    /// Whether a ray is below or above all rays of its sector and the two next to it; of all, if
    /// these have none.
    [[nodiscard]] bool exclude(const auto& way) const {
        const std::size_t sector = sector_of(way), count = sectors_.size();
        limits here = sectors_[sector];
        here.add(sectors_[(sector + 1) % count]);
        here.add(sectors_[(sector + count - 1) % count]);
        if (here.lowest > here.highest) here = all_;
        const double up = dot(axes_.z, way), distance = length(way);
        return here.lowest <= here.highest &&
               (up < here.lowest * distance || up > here.highest * distance);
    }

  private:
    /// Sines of elevations.
    struct limits {
        double lowest = 1.0, highest = -1.0;  // of no ray

        void add(const limits& other) {
            lowest = std::min(lowest, other.lowest);
            highest = std::max(highest, other.highest);
        }
        void enlarge(double by) {
            if (lowest > highest) return;
            constexpr double right = 0.5 * std::numbers::pi;
            lowest = std::sin(std::max(std::asin(std::max(lowest, -1.0)) - by, -right));
            highest = std::sin(std::min(std::asin(std::min(highest, 1.0)) + by, right));
        }
    };

    [[nodiscard]] std::size_t sector_of(const auto& way) const {
        const double azimuth = std::atan2(dot(axes_.y, way), dot(axes_.x, way)) + std::numbers::pi;
        const double width = 2.0 * std::numbers::pi / static_cast<double>(sectors_.size());
        return static_cast<std::size_t>(azimuth / width) % sectors_.size();
    }

    image_axes axes_;
    std::array<limits, 512> sectors_;  // numerical: limits hardly differ within two degrees
    limits all_;
};

}  // namespace gnomon::detail
