// SPDX-License-Identifier: BSL-1.0
/// @file
/// Writes points and their properties to a PLY file (Turk 1994).
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io {

/// Options of `write_ply`.
struct ply_options {
    ply_format format = ply_format::binary_little_endian;  ///< encoding of the file
    field_type coordinates = field_type::float64;          ///< type of x, y, z; or float32
};

namespace detail {

/// The header of the file. A single viewpoint is written as a comment.
template <class = void>
[[nodiscard]] std::string ply_header_text(std::size_t points, const viewpoint_table& viewpoints,
                                          const properties& columns, ply_options options) {
    std::string text = "ply\nformat ";
    text += ply_format_names[static_cast<std::size_t>(options.format)];
    text += " 1.0\n";
    if (viewpoints.positions().size() == 1) {
        text += "comment viewpoint ";
        for (const double coordinate : viewpoints.positions().front())
            append_text(text, coordinate);
        text.back() = '\n';
    }
    text += "element vertex " + std::to_string(points) + "\n";
    const auto declare = [&text](field_type type, const std::string& name) {
        text += "property " + std::string(ply_type_of(type).name) + " " + name + "\n";
    };
    for (const char* const axis : {"x", "y", "z"}) declare(options.coordinates, axis);
    for (const property& column : columns) declare(column.type, column.name);
    return text + "end_header\n";
}

/// Writes the file. Independent of the type of the points, so that it is compiled once.
template <class = void>
void write_ply_rows(const std::string& path, std::size_t points,
                    const std::function<Eigen::Vector3d(std::size_t)>& position_of,
                    const viewpoint_table& viewpoints, const properties& columns,
                    ply_options options) {
    using gnomon::detail::require;
    require(
        options.coordinates == field_type::float32 || options.coordinates == field_type::float64,
        "write_ply: coordinates must be float32 or float64");
    require_columns(columns, points);

    output_file file(path);
    write_rows(file, ply_header_text(points, viewpoints, columns, options), points,
               [&](std::string& bytes, std::size_t i) {
                   for (const double coordinate : position_of(i))
                       append_value(bytes, coordinate, options.coordinates, options.format);
                   for (const property& column : columns)
                       append_value(bytes, column.value(i), column.type, options.format);
                   if (options.format == ply_format::ascii) bytes.back() = '\n';
               });
    file.commit();
}

}  // namespace detail

/// Writes points and properties to the PLY file `path` atomically: an existing file is replaced or
/// stays unchanged.
/// @param path        name of the file
/// @param points      any point range [m]; NaN is written. A single viewpoint is written as a
///                    comment "viewpoint x y z", several as properties viewpoint_x, viewpoint_y,
///                    viewpoint_z; `read_ply` reads both.
/// @param columns     properties of the points in addition to x, y, z
/// @param options     encoding, and type of the coordinates; float64 coordinates are exact
/// @param projection  maps an element of the range to a point
/// @throws gnomon::error          with the operating system's message, e.g. if the disk is full
/// @throws std::invalid_argument  if a property is for another number of points, if its name is
///                                used twice or is not one word, if the type of the coordinates is
///                                not float32 or float64, or if a value is outside the range of its
///                                type
/// Complexity: O(points * properties).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
void write_ply(const std::string& path, const R& points, const properties& columns = {},
               ply_options options = {}, Proj projection = {}) {
    const position_view<R, Proj> positions(points, std::move(projection));
    const viewpoint_table viewpoints = gnomon::detail::viewpoints_of(points);
    detail::write_ply_rows(
        path, positions.size(), [&positions](std::size_t i) { return positions[i]; }, viewpoints,
        detail::with_viewpoint_columns(columns, viewpoints, positions.size()), options);
}

}  // namespace gnomon::io
