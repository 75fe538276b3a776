// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads the points of a legacy VTK file (POLYDATA or UNSTRUCTURED_GRID, ASCII). Cells and data
/// after the points are ignored.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io {
namespace detail {

/// The beginning of a legacy VTK file.
inline constexpr std::string_view vtk_magic = "# vtk DataFile";

/// Reads up to and including the line "POINTS n type".
/// @return n, as declared
/// @throws gnomon::error  if the header is damaged, BINARY or of another kind of data set
/// (A template, as all here, so that unused readers cost no compile time.)
[[nodiscard]] std::uint64_t read_vtk_header(auto& text) {
    if (!text.line().value_or("").starts_with(vtk_magic)) text.fail("not a legacy VTK file");
    static_cast<void>(text.line());  // the title

    const std::string_view encoding = text.words().next().value_or("");
    if (encoding == "BINARY") text.fail("BINARY is not supported; save the file as ASCII");
    if (encoding != "ASCII") text.fail("ASCII or BINARY is missing");

    splitter words = text.words();
    if (words.next() != "DATASET") text.fail("DATASET is missing");
    const std::string_view dataset = words.next().value_or("");
    if (dataset != "POLYDATA" && dataset != "UNSTRUCTURED_GRID")
        text.fail("DATASET " + in_quotes(dataset) + " is not supported");

    // Fields of the whole data set, e.g. its time, can precede the points.
    do words = text.words();
    while (words.next() != "POINTS");
    const std::uint64_t points = text.count(words);
    const std::string_view type = words.next().value_or("");
    if (type != "float" && type != "double") text.fail("points of type " + in_quotes(type));
    return points;
}

/// The scan of a file.
/// @param text  a text_cursor at its beginning
[[nodiscard]] scan read_vtk(auto text, const auto& fields) {
    const auto points = read_vtk_header(text);
    const std::vector<file_column> columns = {{"x"}, {"y"}, {"z"}};
    scan_builder builder(columns, fields, text);
    text.require_rows(points, 3);
    builder.reserve(static_cast<std::size_t>(points));

    // Line breaks can be anywhere between numbers.
    splitter words;
    std::vector<double> row;
    for (std::uint64_t i = 0; i < points; ++i) {
        for (row.clear(); row.size() < 3;) {
            if (words.empty()) words = text.words();
            row.push_back(text.number(words));
        }
        builder.add(row);
    }
    return std::move(builder).finish();
}

}  // namespace detail

/// Parses a legacy VTK file. NaN coordinates are kept. The format has no viewpoints.
/// @param file    name and contents of the file
/// @param fields  names of further columns, as for the other formats; only "x", "y" and "z" exist
/// @return the points [m] in the order of the file
/// @throws gnomon::error  if the file is damaged, BINARY or another kind of data set, or if another
///                        field is requested
/// Complexity: O(bytes).
template <class = void>
[[nodiscard]] scan read_vtk(const input& file, const std::vector<std::string>& fields = {}) {
    return detail::read_vtk(detail::text_cursor(file), fields);
}

}  // namespace gnomon::io
