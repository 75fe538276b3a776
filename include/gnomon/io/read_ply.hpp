// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads the vertices of a PLY file (Turk 1994). Other elements are skipped.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/byte_cursor.hpp>
#include <gnomon/io/detail/ply_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io {
namespace detail {

/// Reads the rows of an ascii file: one element per line.
class ascii_rows {
  public:
    explicit ascii_rows(const text_cursor& text) : text_(text) {}

    void require(const ply_element& e) const { text_.require_rows(e.count, e.properties.size()); }
    void begin() { words_ = text_.words(); }
    [[nodiscard]] double number(scalar_layout) { return text_.number(words_); }
    void end() {
        if (words_.next()) text_.fail("more values than the header declares");
    }
    [[noreturn]] void fail(const std::string& message) const { text_.fail(message); }

  private:
    text_cursor text_;
    splitter words_;
};

/// Reads the rows of a binary file.
class binary_rows {
  public:
    binary_rows(byte_cursor bytes, std::endian order) : bytes_(bytes), order_(order) {}

    void require(const ply_element& e) const { bytes_.require_rows(e.count, e.smallest_row()); }
    void begin() {}
    [[nodiscard]] double number(scalar_layout type) { return bytes_.number(type, order_); }
    void end() {}
    [[noreturn]] void fail(const std::string& message) const { bytes_.fail(message); }

  private:
    byte_cursor bytes_;
    std::endian order_;
};

/// Reads one element into `row`: its numbers. Lists are skipped.
template <class Rows>
void read_ply_row(Rows& rows, const ply_element& element, std::vector<double>& row) {
    row.clear();
    rows.begin();
    for (const ply_property& p : element.properties) {
        if (!p.length) {
            row.push_back(rows.number(p.type));
            continue;
        }
        const double length = rows.number(*p.length);
        if (!(length >= 0 && length <= 0xffffffffU)) rows.fail("a list of impossible length");
        for (auto left = static_cast<std::uint32_t>(length); left > 0; --left)
            static_cast<void>(rows.number(p.type));
    }
    rows.end();
}

/// Skips the elements before the vertices and reads the vertices.
template <class Rows, class Builder>
[[nodiscard]] scan read_ply_vertices(Rows rows, const ply_header& header, Builder builder) {
    std::vector<double> row;
    for (const ply_element& element : header.elements) {
        const bool is_vertex = element.name == "vertex";
        if (element.properties.empty()) continue;  // occupies no bytes in the file
        rows.require(element);
        if (is_vertex) builder.reserve(static_cast<std::size_t>(element.count));
        for (std::uint64_t i = 0; i < element.count; ++i) {
            read_ply_row(rows, element, row);
            if (is_vertex) builder.add(row);
        }
        if (is_vertex) break;
    }
    return std::move(builder).finish(header.viewpoints);
}

/// The scan of a file.
/// @param text  a text_cursor at its beginning
[[nodiscard]] scan read_ply(const input& file, auto text, const auto& fields) {
    const auto header = read_ply_header(text);

    std::vector<file_column> columns;
    for (const auto& element : header.elements) {
        if (element.name != "vertex") continue;
        for (const auto& p : element.properties)
            if (!p.length) columns.push_back({p.name, field_type_of(p.type)});
        break;
    }
    scan_builder builder(columns, fields, text);

    if (header.format == ply_format::ascii)
        return read_ply_vertices(ascii_rows(text), header, std::move(builder));
    const std::endian order =
        header.format == ply_format::binary_big_endian ? std::endian::big : std::endian::little;
    return read_ply_vertices(binary_rows({file, text.offset()}, order), header, std::move(builder));
}

}  // namespace detail

/// Parses a PLY file, ascii or binary of either byte order. NaN coordinates are kept. Properties
/// viewpoint_x, viewpoint_y, viewpoint_z, or a comment "viewpoint x y z", both as `write_ply`
/// writes them, become the viewpoints [m].
/// @param file    name and contents of the file
/// @param fields  names of further properties of the vertices, e.g. "nx", that become fields; "*"
///                stands for all but lists. Their types are kept: see `field_properties`
/// @return the vertices [m] in the order of the file, with viewpoints and fields
/// @throws gnomon::error  if the file is damaged, or if x, y, z or a field is missing
/// Complexity: O(bytes).
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] scan read_ply(const input& file, const std::vector<std::string>& fields = {}) {
    return detail::read_ply(file, detail::text_cursor(file), fields);
}

}  // namespace gnomon::io
