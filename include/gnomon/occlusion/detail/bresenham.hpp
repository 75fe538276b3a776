// SPDX-License-Identifier: BSL-1.0
/// @file
/// The pixels of a straight line in a range image, by the shorter way around: across the seam where
/// azimuth pi meets -pi, if that is nearer (Bresenham 1965; Klasing 2010, Sec. 4.3.2).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>

#include <gnomon/occlusion/range_image.hpp>

namespace gnomon::detail {

/// Calls visit(pixel, share) from one pixel to another, both included; share is how far along, from
/// 0 to 1.
inline void for_each_pixel_between(const range_image& image, const range_image::pixel& from,
                                   const range_image::pixel& to, auto&& visit) {
    const auto width = static_cast<std::int64_t>(image.width());
    auto across = static_cast<std::int64_t>(to.azimuth) - static_cast<std::int64_t>(from.azimuth);
    if (2 * across > width) across -= width;
    if (2 * across < -width) across += width;
    const auto up =
        static_cast<std::int64_t>(to.elevation) - static_cast<std::int64_t>(from.elevation);
    const std::int64_t steps = std::max(std::abs(across), std::abs(up));
    // Rounded to the nearest, halves away from the start.
    const auto at = [steps](std::int64_t way, std::int64_t step) {
        if (steps == 0) return std::int64_t{0};
        const std::int64_t twice = 2 * std::abs(way) * step + steps;
        return (way < 0 ? -1 : 1) * (twice / (2 * steps));
    };
    for (std::int64_t s = 0; s <= steps; ++s) {
        const std::int64_t azimuth =
            (static_cast<std::int64_t>(from.azimuth) + at(across, s) + width) % width;
        const std::int64_t elevation = static_cast<std::int64_t>(from.elevation) + at(up, s);
        const double share = steps == 0 ? 0.0 : static_cast<double>(s) / static_cast<double>(steps);
        visit(range_image::pixel{static_cast<std::size_t>(azimuth),
                                 static_cast<std::size_t>(elevation)},
              share);
    }
}

}  // namespace gnomon::detail
