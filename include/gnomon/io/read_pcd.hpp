// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads the point cloud files of PCL (PCD): ascii, binary and binary_compressed.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/byte_cursor.hpp>
#include <gnomon/io/detail/lzf.hpp>
#include <gnomon/io/detail/pcd_columns.hpp>
#include <gnomon/io/detail/pcd_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io {
namespace detail {

/// The place of a column in binary data: the value of point i is at byte first + i * stride.
struct pcd_column {
    scalar_layout type;
    std::size_t first;
    std::size_t stride;
};

/// The places of the columns in binary data: point after point, each of `stride` bytes.
template <class = void>
[[nodiscard]] std::vector<pcd_column> interleaved_columns(const pcd_header& header,
                                                          std::size_t stride) {
    std::vector<pcd_column> result;
    std::size_t first = 0;
    for (const pcd_field& field : header.fields)
        for (std::size_t k = 0; k < field.count; ++k, first += field.type.size)
            result.push_back({field.type, first, stride});
    return result;
}

/// The places of the columns in binary_compressed data: field after field, each for all points.
template <class = void>
[[nodiscard]] std::vector<pcd_column> planar_columns(const pcd_header& header, std::size_t points) {
    std::vector<pcd_column> result;
    std::size_t first = 0;
    for (const pcd_field& field : header.fields) {
        for (std::size_t k = 0; k < field.count; ++k)
            result.push_back({field.type, first + k * field.type.size, field.size()});
        first += points * field.size();
    }
    return result;
}

/// Appends the places of the bytes of colors.
template <class = void>
[[nodiscard]] std::vector<pcd_column> with_colors(std::vector<pcd_column> columns,
                                                  const auto& table) {
    for (const auto& c : table.colors) {
        const pcd_column source = columns[c.source];
        columns.push_back({{'U', 1}, source.first + c.byte, source.stride});
    }
    return columns;
}

/// Adds the points in binary `data`. The PCD format does not define a byte order; all writers use
/// little-endian.
void add_pcd_points(auto& builder, std::string_view data, const std::vector<pcd_column>& columns,
                    std::size_t points) {
    std::vector<double> row(columns.size());
    builder.reserve(points);
    for (std::size_t i = 0; i < points; ++i) {
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const pcd_column& c = columns[k];
            row[k] = decode(data.data() + c.first + i * c.stride, c.type, std::endian::little);
        }
        builder.add(row);
    }
}

/// Reads the points of ascii data, one per line.
void read_pcd_ascii(auto& builder, auto text, std::uint64_t points, const auto& table) {
    text.require_rows(points, table.values());
    builder.reserve(static_cast<std::size_t>(points));
    std::vector<double> row;
    for (std::uint64_t i = 0; i < points; ++i) {
        splitter words = text.words();
        row.resize(table.values());
        for (double& value : row) value = text.number(words);
        if (words.next()) text.fail("more values than the header declares");
        table.append_colors(row);
        builder.add(row);
    }
}

/// Reads the points of binary data.
void read_pcd_binary(auto& builder, byte_cursor bytes, const pcd_header& header, const auto& table,
                     std::size_t stride) {
    bytes.require_rows(header.points, stride);
    const auto points = static_cast<std::size_t>(header.points);
    add_pcd_points(builder, bytes.take(points * stride),
                   with_colors(interleaved_columns(header, stride), table), points);
}

/// Reads the points of binary_compressed data: two sizes, then LZF.
void read_pcd_compressed(auto& builder, byte_cursor bytes, const pcd_header& header,
                         const auto& table, std::size_t stride) {
    const auto size = [&bytes] {
        return static_cast<std::size_t>(bytes.number({'U', 4}, std::endian::little));
    };
    const std::size_t packed_size = size();
    const std::size_t unpacked_size = size();
    if (header.points != unpacked_size / stride || unpacked_size % stride != 0)
        bytes.fail("the compressed data are not of the size that the header declares");
    byte_cursor after = bytes;
    const std::optional<std::string> data = unpack_lzf(after.take(packed_size), unpacked_size);
    if (!data) bytes.fail("the compressed data are damaged");
    const std::size_t points = unpacked_size / stride;
    add_pcd_points(builder, *data, with_colors(planar_columns(header, points), table), points);
}

/// The scan of a file.
/// @param text  a text_cursor at its beginning
[[nodiscard]] scan read_pcd(const input& file, auto text, const auto& fields) {
    const auto header = read_pcd_header(text);
    const pcd_table table(header, !fields.empty());
    scan_builder builder(table.columns, fields, text);

    std::size_t stride = 0;
    for (const auto& field : header.fields) stride += field.size();
    const byte_cursor bytes(file, text.offset());

    if (header.data == "ascii")
        read_pcd_ascii(builder, text, header.points, table);
    else if (header.data == "binary")
        read_pcd_binary(builder, bytes, header, table, stride);
    else if (header.data == "binary_compressed")
        read_pcd_compressed(builder, bytes, header, table, stride);
    else
        text.fail("DATA " + in_quotes(header.data) + " is not known");
    scan result = std::move(builder).finish(header.viewpoints);
    result.width = static_cast<std::size_t>(header.width);
    return result;
}

}  // namespace detail

/// Parses a PCD file. NaN coordinates are kept. The position in VIEWPOINT becomes the viewpoint
/// [m]; its orientation is not applied, so the points stay in the frame of the file.
/// @param file    name and contents of the file
/// @param fields  names of further fields, e.g. "intensity", or "fpfh[0]" of several values; "red",
///                "green", "blue" and "alpha" of a field "rgb" or "rgba"; "*" stands for all
/// @return the points [m] in the order of the file, with viewpoint and fields; `width` is set if
///         the file has several rows
/// @throws gnomon::error  if the file is damaged, or if x, y, z or a field is missing
/// Complexity: O(bytes).
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] scan read_pcd(const input& file, const std::vector<std::string>& fields = {}) {
    return detail::read_pcd(file, detail::text_cursor(file), fields);
}

}  // namespace gnomon::io
