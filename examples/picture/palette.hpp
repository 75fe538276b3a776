// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which color has a segment? Labels count from the largest segment down, so that the colors that
/// differ most go to those that are seen most.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

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

/// The color of a label: twenty of them, then the same ones lighter; grey for the unlabeled.
[[nodiscard]] inline color color_of(std::int32_t label) {
    static constexpr std::array<color, 20> colors{{
        {66, 133, 200},  {240, 140, 45},  {70, 165, 90},   {214, 65, 70},   {145, 105, 190},
        {64, 190, 200},  {225, 105, 175}, {190, 185, 50},  {155, 100, 70},  {95, 95, 215},
        {245, 195, 60},  {25, 130, 130},  {250, 130, 115}, {135, 200, 75},  {165, 45, 115},
        {120, 180, 240}, {200, 130, 20},  {110, 125, 50},  {205, 140, 225}, {70, 85, 130},
    }};
    if (label < 0) return no_segment;
    const auto number = static_cast<std::size_t>(label);
    const double lightness = 0.25 * static_cast<double>((number / colors.size()) % 3);
    return mixed(colors[number % colors.size()], white, lightness);
}

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
