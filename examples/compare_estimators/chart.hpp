// SPDX-License-Identifier: BSL-1.0
/// @file
/// A chart of all methods: a row for each, with four bars.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include "picture/image.hpp"
#include "picture/palette.hpp"

/// The results of one method.
struct row {
    std::string name;
    double gamma;                 ///< 0 to 1
    double median, p90, rms;      ///< errors [degrees]
    double microseconds;          ///< per normal, without the search
    std::array<double, 3> trust;  ///< shares that are good, weak and unusable
};

namespace chart {

inline constexpr int row_height = 26;
inline constexpr int name_width = 290;
inline constexpr int column_width = 310;
inline constexpr int top = 120;

inline constexpr picture::color good{70, 165, 90};
inline constexpr picture::color weak{240, 190, 60};
inline constexpr picture::color unusable{214, 65, 70};
inline constexpr picture::color bar{66, 133, 200};
inline constexpr picture::color light_bar{170, 203, 233};
inline constexpr picture::color rule{225, 227, 231};

inline std::string number(const char* format, double value) {
    char text[32];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

/// A column of bars: its heading, and where it stands.
struct column {
    picture::image& sheet;
    int left;

    [[nodiscard]] int width() const { return column_width - 110; }

    /// With two lines of explanation.
    void head(const std::string& title, const std::string& first, const std::string& second) const {
        sheet.write(left, 42, title);
        sheet.write(left, 70, first, picture::no_segment, picture::small_text_size);
        sheet.write(left, 92, second, picture::no_segment, picture::small_text_size);
    }

    /// A bar from `from` to `to`, in shares of the width.
    void draw(std::size_t i, double from, double to, const picture::color& c) const {
        const int y = top + static_cast<int>(i) * row_height;
        const auto x = [&](double share) {
            return left + static_cast<int>(std::lround(std::clamp(share, 0.0, 1.0) * width()));
        };
        sheet.fill(x(from), y + 4, std::max(x(to), x(from) + 1), y + row_height - 4, c);
    }

    void write(std::size_t i, const std::string& text) const {
        const int y = top + static_cast<int>(i) * row_height;
        sheet.write(left + width() + 6, y + 8, text, picture::ink, picture::small_text_size);
    }
};

}  // namespace chart

/// The picture of the table.
inline picture::image chart_of(const std::vector<row>& rows, const std::string& title) {
    using namespace chart;
    const int height = top + static_cast<int>(rows.size()) * row_height + 40;
    picture::image sheet(name_width + 4 * column_width + 20, height);
    sheet.write(16, 12, title);
    for (std::size_t i = 0; i <= rows.size(); ++i) {
        const int y = top + static_cast<int>(i) * row_height;
        sheet.fill(16, y, sheet.width() - 16, y + 1, rule);
        if (i < rows.size())
            sheet.write(16, y + 8, rows[i].name, picture::ink, picture::small_text_size);
    }
    const auto at = [&](int i) { return column{sheet, name_width + i * column_width}; };

    double worst_gamma = 1.0;
    double largest_error = 1.0;
    double slowest = 0.1;
    double fastest = 1e9;
    for (const row& r : rows) {
        worst_gamma = std::min(worst_gamma, r.gamma);
        largest_error = std::max(largest_error, r.p90);
        slowest = std::max(slowest, r.microseconds);
        fastest = std::min(fastest, r.microseconds);
    }
    const double low = std::floor(10.0 * worst_gamma) / 10.0;
    const double decades = std::log10(slowest / fastest) + 0.2;

    at(0).head("gamma", "mean |<n, truth>|, from " + number("%.1f", low) + " to 1",
               "longer is better");
    at(1).head("error", "dark: median, light: 90 % of points",
               "to " + number("%.0f", largest_error) + "\u00b0");
    at(2).head("time", "\u00b5s per normal without the search", "log scale");
    at(3).head("trust", "green: good, yellow: weak", "red: no normal");
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const row& r = rows[i];
        at(0).draw(i, 0.0, (r.gamma - low) / (1.0 - low), bar);
        at(0).write(i, number("%.4f", r.gamma));
        at(1).draw(i, 0.0, r.p90 / largest_error, light_bar);
        at(1).draw(i, 0.0, r.median / largest_error, bar);
        at(1).write(i, number("%.1f", r.median) + " / " + number("%.1f", r.p90));
        at(2).draw(i, 0.0, (std::log10(r.microseconds / fastest) + 0.2) / decades, bar);
        at(2).write(i, number("%.2f", r.microseconds));
        at(3).draw(i, 0.0, r.trust[0], good);
        at(3).draw(i, r.trust[0], r.trust[0] + r.trust[1], weak);
        if (r.trust[2] > 0.0) at(3).draw(i, r.trust[0] + r.trust[1], 1.0, unusable);
        at(3).write(i, number("%.1f", 100.0 * r.trust[0]) + " % good");
    }
    return sheet;
}
