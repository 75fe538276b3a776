// SPDX-License-Identifier: BSL-1.0
/// @file
/// The pixels of a straight line in a range image, by the shorter way around: across the seam where
/// azimuth pi meets -pi, if that is nearer (Bresenham 1965; Klasing 2010, Sec. 4.3.2).
#pragma once

#include <algorithm>
#include <cstddef>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/occlusion/range_image.hpp>

namespace gnomon::detail {

/// Calls visit(pixel, share) from one pixel to another, both included; share is how far along, from
/// 0 to 1.
inline void for_each_pixel_between(const range_image& image, const range_image::pixel& from,
                                   const range_image::pixel& to, auto&& visit) {
    const auto column = static_cast<double>(from.azimuth),
               row = static_cast<double>(from.elevation);
    const auto width = static_cast<double>(image.width());
    const double across = std::remainder(static_cast<double>(to.azimuth) - column, width);
    const double up = static_cast<double>(to.elevation) - row;
    const double steps = std::max(std::abs(across), std::abs(up)), most = std::max(steps, 1.0);
    for (double s = 0.0; s <= steps; s += 1.0) {
        const double azimuth = column + std::round(across * s / most) + width;
        const double elevation = row + std::round(up * s / most);
        visit(range_image::pixel{static_cast<std::size_t>(azimuth) % image.width(),
                                 static_cast<std::size_t>(elevation)},
              s / most);
    }
}

}  // namespace gnomon::detail
