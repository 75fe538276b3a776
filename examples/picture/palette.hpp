// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which color has a segment, and what surrounds it? Segments have the colors of their labels.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include <gnomon/io/label_properties.hpp>

namespace picture {

using color = std::array<std::uint8_t, 3>;  ///< red, green, blue

inline constexpr color white{255, 255, 255};
inline constexpr color ink{45, 48, 56};
inline constexpr color no_segment{150, 152, 156};

/// `a` at t = 0, `b` at t = 1.
[[nodiscard]] inline color mixed(const color& a, const color& b, double t) {
    color c{};
    for (std::size_t i = 0; i < 3; ++i) {
        c[i] = static_cast<std::uint8_t>((1.0 - t) * a[i] + t * b[i] + 0.5);
    }
    return c;
}

/// The color of a label, that which files have.
[[nodiscard]] inline color color_of(std::int32_t label) { return gnomon::io::label_color(label); }

/// Steps from calm to alarming: 0 is green, 5 is red; the last is also that of all beyond.
[[nodiscard]] inline color warning_color(std::int32_t step) {
    static constexpr std::array<color, 6> colors{{{40, 140, 90},
                                                  {130, 190, 95},
                                                  {225, 215, 100},
                                                  {245, 165, 70},
                                                  {230, 90, 60},
                                                  {160, 30, 60}}};
    if (step < 0) return no_segment;
    return colors[std::min(static_cast<std::size_t>(step), colors.size() - 1)];
}

}  // namespace picture
