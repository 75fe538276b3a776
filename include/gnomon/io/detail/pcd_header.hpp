// SPDX-License-Identifier: BSL-1.0
/// @file
/// The header of a PCD file: fields, number of points and encoding. Accepts the PCD v0.7 format of
/// PCL (Rusu and Cousins 2011) and its less strict predecessors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>

namespace gnomon::io::detail {

/// A field of the points: one or several values.
struct pcd_field {
    std::string name;
    scalar_layout type{'F', 4};  // the default of files without TYPE and SIZE
    std::size_t count = 1;       // number of values

    /// The size of the field of one point [bytes].
    [[nodiscard]] std::size_t size() const { return type.size * count; }
};

/// The contents of the header.
struct pcd_header {
    std::vector<pcd_field> fields;
    std::uint64_t points = 0;    // as declared
    std::uint64_t width = 0;     // of an organized image, which has several rows; else 0
    viewpoint_table viewpoints;  // one viewpoint, or none
    std::string data;            // "ascii", "binary" or "binary_compressed"
};

/// The keywords of the header, at the beginning of a line.
inline constexpr std::array<std::string_view, 11> pcd_keywords = {
    "VERSION", "FIELDS", "COLUMNS",   "SIZE",   "TYPE", "COUNT",
    "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};

/// Returns whether `word` is a keyword of the header.
[[nodiscard]] inline bool is_pcd_keyword(std::string_view word) {
    return std::find(pcd_keywords.begin(), pcd_keywords.end(), word) != pcd_keywords.end();
}

/// The lines of the header, by keyword, before they are checked against each other.
struct pcd_lines {
    splitter fields, size, type, count, viewpoint, data;
    std::optional<std::uint64_t> width, height, points;
    bool has_size = false, has_type = false, has_count = false, has_viewpoint = false;
};

/// Reads up to and including the line "DATA". Lines before the first keyword are comments, also
/// without '#': some writers break a comment over two lines.
/// @throws gnomon::error  for an unknown keyword, or if the file ends
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] pcd_lines read_pcd_lines(text_cursor& text) {
    pcd_lines lines;
    bool begun = false;
    for (;;) {
        splitter words = text.words();
        const std::string_view keyword = words.next().value_or("");
        if (keyword.starts_with('#') || (!begun && !is_pcd_keyword(keyword))) continue;
        begun = true;
        if (keyword == "FIELDS" || keyword == "COLUMNS") {
            lines.fields = words;
        } else if (keyword == "SIZE") {
            lines.size = words;
            lines.has_size = true;
        } else if (keyword == "TYPE") {
            lines.type = words;
            lines.has_type = true;
        } else if (keyword == "COUNT") {
            lines.count = words;
            lines.has_count = true;
        } else if (keyword == "VIEWPOINT") {
            lines.viewpoint = words;
            lines.has_viewpoint = true;
        } else if (keyword == "WIDTH") {
            lines.width = text.count(words);
        } else if (keyword == "HEIGHT") {
            lines.height = text.count(words);
        } else if (keyword == "POINTS") {
            lines.points = text.count(words);
        } else if (keyword == "DATA") {
            lines.data = words;
            return lines;
        } else if (keyword != "VERSION") {
            text.fail(in_quotes(keyword) + " is not a keyword of PCD");
        }
    }
}

/// Reads the header and leaves `text` at the first byte of the data.
/// @throws gnomon::error  if the header is damaged or inconsistent
template <class = void>
[[nodiscard]] pcd_header read_pcd_header(text_cursor& text) {
    pcd_lines lines = read_pcd_lines(text);
    pcd_header header;

    std::size_t values = 0;
    while (const auto name = lines.fields.next()) {
        pcd_field field{std::string(*name)};
        if (lines.has_type) {
            const std::string_view type = lines.type.next().value_or("");
            if (type.size() != 1)
                text.fail("TYPE of " + in_quotes(*name) + " is missing or unknown");
            field.type.kind = type.front();
        }
        if (lines.has_size) field.type.size = text.size(lines.size);
        if (lines.has_count) field.count = text.size(lines.count);
        if (!visit_type(field.type, [](auto) {}))
            text.fail("TYPE and SIZE of " + in_quotes(*name) + " do not go together");
        // Bounds the memory for a damaged header; far above the length of any descriptor.
        constexpr std::size_t max_values = 1 << 16;
        if (field.count == 0 || field.count > max_values - values)
            text.fail("COUNT of " + in_quotes(*name) + " is impossible");
        values += field.count;
        header.fields.push_back(std::move(field));
    }
    if (lines.size.next() || lines.type.next() || lines.count.next())
        text.fail("SIZE, TYPE or COUNT lists more fields than FIELDS");

    if (lines.width) {
        const std::uint64_t height = lines.height.value_or(1);
        if (height != 0 && *lines.width > std::numeric_limits<std::uint64_t>::max() / height)
            text.fail("WIDTH * HEIGHT is impossible");
        if (lines.points.value_or(*lines.width * height) != *lines.width * height)
            text.fail("WIDTH * HEIGHT is not POINTS");
        lines.points = *lines.width * height;
        if (height > 1) header.width = *lines.width;
    }
    if (!lines.points) text.fail("the header has neither WIDTH nor POINTS");
    header.points = *lines.points;

    if (lines.has_viewpoint) {
        // The orientation after the position is ignored: the points stay in the frame of the file.
        Eigen::Vector3d viewpoint;
        for (double& coordinate : viewpoint) coordinate = text.number(lines.viewpoint);
        header.viewpoints = viewpoint;
    }
    header.data = lines.data.next().value_or("");
    return header;
}

}  // namespace gnomon::io::detail
