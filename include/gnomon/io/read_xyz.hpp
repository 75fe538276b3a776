// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads text files of one point per line (.xyz, .txt, .csv, .asc): x y z, then any number of
/// further columns, separated by blanks, commas or semicolons.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/number.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io {
namespace detail {

/// The words of a line of values. If the line has a semicolon, commas do not separate, so a decimal
/// comma is an error and not a separator.
[[nodiscard]] inline splitter split_values(std::string_view line) {
    return splitter(line, line.find(';') == std::string_view::npos ? ',' : ';');
}

/// Returns whether a line that begins with `word` holds values, possibly damaged, and not names.
[[nodiscard]] inline bool begins_values(std::string_view word) {
    constexpr std::string_view beginnings = "+-.0123456789";
    return is_number(word) || beginnings.find(word.substr(0, 1)) != std::string_view::npos;
}

/// The name of a column without surrounding quotes.
[[nodiscard]] inline std::string_view unquoted(std::string_view word) {
    const bool quoted = word.size() >= 2 && (word.front() == '"' || word.front() == '\'') &&
                        word.back() == word.front();
    return quoted ? word.substr(1, word.size() - 2) : word;
}

/// Returns the names of the columns from the first line: the names in it, or "x", "y", "z",
/// "column 3", "column 4", ... if it holds values.
/// @param words      of the first line
/// @param has_names  whether the line holds names
/// @throws gnomon::error  for fewer than three columns, a numeric name, or a misplaced axis
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] std::vector<file_column> xyz_columns(splitter words, bool has_names,
                                                   const text_cursor& text) {
    constexpr std::string_view axes = "xyzXYZ";
    std::vector<file_column> result;
    while (const auto word = words.next()) {
        const std::size_t k = result.size();
        const std::string_view name = unquoted(*word);
        const std::size_t axis = name.size() == 1 ? axes.find(name) : std::string_view::npos;
        const bool is_axis_of_another = axis != std::string_view::npos && axis % 3 != k;
        if (has_names && (is_number(name) || is_axis_of_another))
            text.fail(in_quotes(*word) + " cannot be the name of column " + std::to_string(k));
        if (k < 3)
            result.push_back({std::string(axes.substr(k, 1))});
        else
            result.push_back({has_names ? std::string(name) : "column " + std::to_string(k)});
    }
    if (result.size() < 3)
        text.fail("fewer than three columns; supported formats are text, PLY, PCD and legacy VTK");
    return result;
}

/// The scan of a file.
/// @param text  a text_cursor at its beginning
[[nodiscard]] scan read_xyz(auto text, const auto& fields) {
    text.skip("\xEF\xBB\xBF");  // the byte order mark of some editors
    std::optional<scan_builder<decltype(text)>> builder;
    std::vector<double> row;
    bool has_points = false;
    while (const auto line = text.line()) {
        splitter words = split_values(*line);
        if (words.empty()) continue;
        splitter ahead = words;
        const std::string_view first = ahead.next().value_or("");
        if (first.starts_with('#') || first.starts_with("//")) continue;
        if (!builder) {
            const bool has_names = !begins_values(first);
            const auto columns = xyz_columns(words, has_names, text);
            builder.emplace(columns, fields, text);
            row.resize(columns.size());
            if (has_names) continue;
        }
        for (double& value : row) value = text.number(words);
        if (!words.empty()) text.fail("more values than on the lines before");
        builder->add(row);
        has_points = true;
    }
    if (!has_points) text.fail("no points");
    return std::move(*builder).finish();
}

}  // namespace detail

/// Parses a text with x y z [m] first on each line. Blank lines and lines that begin with '#' or
/// "//" are skipped. A first line that does not begin with a number names the columns.
/// @param file    name and contents of the file
/// @param fields  names of further columns that become fields: those of the first line, or
///                "column 3", "column 4", ..., counted from 0; "*" stands for all
/// @return the points in the order of the file; no viewpoints
/// @throws gnomon::error  if a line does not hold as many numbers as the first, if there is no
///                        point, or if a field is missing
/// Complexity: O(bytes).
template <class = void>
[[nodiscard]] scan read_xyz(const input& file, const std::vector<std::string>& fields = {}) {
    return detail::read_xyz(detail::text_cursor(file), fields);
}

}  // namespace gnomon::io
