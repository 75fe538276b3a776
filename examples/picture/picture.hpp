// SPDX-License-Identifier: BSL-1.0
/// @file
/// A scan in groups, such as segments, in one picture: two views side by side, captions above, a
/// legend below.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "image.hpp"
#include "palette.hpp"
#include "scene.hpp"
#include "splat.hpp"
#include <gnomon/core/execution.hpp>

namespace picture {

/// A number with a comma at the thousands.
[[nodiscard]] inline std::string with_commas(std::size_t n) {
    std::string digits = std::to_string(n);
    for (std::size_t i = digits.size(); i > 3; i -= 3) digits.insert(i - 3, 1, ',');
    return digits;
}

/// A number with its unit: "1 point", "2 points".
[[nodiscard]] inline std::string counted(std::size_t n, const std::string& thing) {
    return with_commas(n) + " " + thing + (n == 1 ? "" : "s");
}

/// What is drawn over a picture, and the legend of its colors.
struct annotation : overlay {
    std::vector<std::pair<color, std::string>> legend;
};

/// The picture of a scan in groups.
/// @param splats     its finite points
/// @param legend     texts for the groups, by label
/// @param group      what a group is called
/// @param viewpoint  where the sensor stood [m]
/// @param up         against gravity; guessed if not known
/// @param color_in_legend  of a label
/// @param lines      drawn over it
/// @param run        how the views are drawn; the pixels do not depend on it
template <gnomon::execution X = gnomon::sequential>
[[nodiscard]] image picture_of(const std::vector<splat>& splats,
                               const std::vector<std::string>& legend, const std::string& group,
                               const Eigen::Vector3d& viewpoint,
                               const std::optional<Eigen::Vector3d>& up = {},
                               color (*color_in_legend)(std::int32_t) = color_of,
                               const annotation& lines = {}, const X& run = {}) {
    constexpr int margin = 24;
    constexpr int width = 764;
    constexpr int height = 660;
    constexpr int top = 60;
    constexpr color line{222, 224, 228};
    image sheet(3 * margin + 2 * width, top + height + (lines.legend.empty() ? 80 : 116));

    if (splats.empty()) {
        sheet.write(margin, margin, "no points");
    } else {
        const auto views = scene(splats, viewpoint, up).views();
        std::array<image, 2> drawings{image(0, 0), image(0, 0)};
        run(views.size(), [&](std::size_t i) {
            drawings[i] = drawn(splats, lines, views[i].from, width, height, views[i].back);
        });
        int x = margin;
        for (std::size_t i = 0; i < views.size(); ++i) {
            sheet.write(x, 22, views[i].caption);
            sheet.fill(x - 1, top - 1, x + width + 1, top + height + 1, line);
            sheet.paste(drawings[i], x, top);
            x += width + margin;
        }
    }

    int x = margin, y = top + height + 30;
    const auto explain = [&](const color& c, const std::string& text) {
        const int end = x + 28 + image::width_of(text) + 24;
        if (end > sheet.width()) return;
        sheet.fill(x, y - 4, x + 20, y + 18, c);
        sheet.write(x + 28, y, text);
        x = end;
    };
    const std::string title =
        counted(splats.size(), "point") + ", " + counted(legend.size(), group);
    sheet.write(margin, y, title);
    x += image::width_of(title) + 40;
    for (std::size_t label = 0; label < legend.size() && label < 8; ++label)
        explain(color_in_legend(static_cast<std::int32_t>(label)), legend[label]);
    x = margin, y += 36;
    for (const auto& [tint, text] : lines.legend) explain(tint, text);
    return sheet;
}

}  // namespace picture
