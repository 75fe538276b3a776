// SPDX-License-Identifier: BSL-1.0
/// @file
/// The header of a PLY file: encoding, elements and their properties.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/number.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io::detail {

/// A property of an element: a number, or a list of numbers preceded by its length.
struct ply_property {
    std::string name;
    scalar_layout type;                   // of the number or of the numbers of the list
    std::optional<scalar_layout> length;  // type of the length of a list; none for a number
};

/// An element, such as "vertex": a table with one row per instance.
struct ply_element {
    std::string name;
    std::uint64_t count;  // number of rows, as declared
    std::vector<ply_property> properties;

    /// The size of a binary row if all its lists are empty [bytes].
    [[nodiscard]] std::size_t smallest_row() const {
        std::size_t size = 0;
        for (const ply_property& p : properties) size += p.length.value_or(p.type).size;
        return size;
    }
};

/// The contents of the header.
struct ply_header {
    std::optional<ply_format> format;
    std::vector<ply_element> elements;  // in the order of the file
    viewpoint_table viewpoints;         // of the comment "viewpoint x y z"
};

/// Reads the name of a scalar type.
/// @throws gnomon::error  if there is no such type
[[nodiscard]] inline scalar_layout read_ply_type(splitter& words, const text_cursor& text) {
    const std::string_view name = words.next().value_or("");
    for (const ply_type& type : ply_types)
        if (name == type.name || name == type.later_name) return type.layout;
    text.fail(in_quotes(name) + " is not a type of PLY");
}

/// Reads a line after its keyword "property".
/// @throws gnomon::error  if it is damaged
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] ply_property read_ply_property(splitter words, const text_cursor& text) {
    ply_property result{};
    splitter ahead = words;
    if (ahead.next() == "list") {
        result.length = read_ply_type(ahead, text);
        if (result.length->kind == 'F') text.fail("a list must be counted in integers");
        words = ahead;
    }
    result.type = read_ply_type(words, text);
    result.name = words.next().value_or("");
    if (result.name.empty()) text.fail("the property has no name");
    return result;
}

/// Reads a line after its keyword "comment". `write_ply` writes the viewpoint as a comment, since
/// PLY has no keyword for it.
/// @return the viewpoint [m]; none if the comment is another one
template <class = void>
[[nodiscard]] std::optional<Eigen::Vector3d> read_viewpoint_comment(splitter words) {
    if (words.next() != "viewpoint") return std::nullopt;
    Eigen::Vector3d result;
    for (double& coordinate : result)
        if (parse_number(words.next().value_or(""), coordinate) != std::errc{}) return std::nullopt;
    if (words.next()) return std::nullopt;
    return result;
}

/// Reads the header and leaves `text` at the first byte of the first element.
/// @throws gnomon::error  if the header is damaged or not that of a PLY file
template <class = void>
[[nodiscard]] ply_header read_ply_header(text_cursor& text) {
    ply_header header;
    if (text.words().next() != "ply") text.fail("not a PLY file");
    for (;;) {
        splitter words = text.words();
        const std::string_view keyword = words.next().value_or("");
        if (keyword == "end_header") break;
        if (keyword == "comment") {
            if (const auto viewpoint = read_viewpoint_comment(words))
                header.viewpoints = *viewpoint;
        } else if (keyword == "format") {
            const std::string_view name = words.next().value_or("");
            const auto found = std::find(ply_format_names.begin(), ply_format_names.end(), name);
            if (found == ply_format_names.end())
                text.fail(in_quotes(name) + " is not a PLY format");
            header.format = static_cast<ply_format>(found - ply_format_names.begin());
        } else if (keyword == "element") {
            std::string name(words.next().value_or(""));
            header.elements.push_back({std::move(name), text.count(words), {}});
        } else if (keyword == "property") {
            if (header.elements.empty()) text.fail("a property of no element");
            header.elements.back().properties.push_back(read_ply_property(words, text));
        } else if (keyword != "obj_info") {
            text.fail(in_quotes(keyword) + " is not a keyword of PLY");
        }
    }
    if (!header.format) text.fail("the header names no format");
    return header;
}

}  // namespace gnomon::io::detail
