// SPDX-License-Identifier: BSL-1.0
/// @file
/// Writes points and their properties to a PCD file (version 0.7) that PCL reads.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/detail/pcl_properties.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io {

/// Options of `write_pcd`.
struct pcd_options {
    bool ascii = false;  ///< text instead of binary data
    /// Type of x, y, z: float32, which the point types of PCL have, or float64.
    field_type coordinates = field_type::float32;
};

namespace detail {

/// The header of the file.
/// @param width  of an organized image; 0 for a list of points
template <class = void>  // templates, so that unused writers cost no compile time
[[nodiscard]] std::string pcd_header_text(std::size_t points, std::size_t width,
                                          const viewpoint_table& viewpoints,
                                          const properties& columns, const pcd_options& options) {
    std::string fields = "FIELDS", sizes = "SIZE", types = "TYPE", counts = "COUNT";
    const auto declare = [&](field_type type, const std::string& name) {
        const scalar_layout layout = ply_type_of(type).layout;
        fields += " " + name;
        sizes += " " + std::to_string(layout.size);
        (types += " ") += layout.kind;
        counts += " 1";
    };
    for (const char* const axis : {"x", "y", "z"}) declare(options.coordinates, axis);
    for (const property& column : columns) declare(column.type, column.name);

    const bool has_one = viewpoints.positions().size() == 1;
    const Eigen::Vector3d viewpoint =
        has_one ? viewpoints.positions().front() : Eigen::Vector3d(0.0, 0.0, 0.0);
    std::string text = "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + fields + "\n" +
                       sizes + "\n" + types + "\n" + counts + "\n";
    text += "WIDTH " + std::to_string(width == 0 ? points : width) + "\n";
    text += "HEIGHT " + std::to_string(width == 0 ? 1 : points / width) + "\nVIEWPOINT ";
    for (const double coordinate : viewpoint) append_text(text, coordinate);
    text += "1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA ";
    return text + (options.ascii ? "ascii\n" : "binary\n");
}

/// Writes the file. Independent of the type of the points, so that it is compiled once.
template <class = void>
void write_pcd_rows(const std::string& path, std::size_t points, std::size_t width,
                    const std::function<Eigen::Vector3d(std::size_t)>& position_of,
                    const viewpoint_table& viewpoints, const properties& columns,
                    const pcd_options& options) {
    using gnomon::detail::require;
    require(
        options.coordinates == field_type::float32 || options.coordinates == field_type::float64,
        "write_pcd: coordinates must be float32 or float64");
    require(width == 0 || points % width == 0,
            "write_pcd: the points are not whole rows of the width");
    require_columns(columns, points);

    const ply_format format = options.ascii ? ply_format::ascii : ply_format::binary_little_endian;
    output_file file(path);
    write_rows(file, pcd_header_text(points, width, viewpoints, columns, options), points,
               [&](std::string& bytes, std::size_t i) {
                   for (const double coordinate : position_of(i))
                       append_coordinate(bytes, coordinate, options.coordinates, format);
                   for (const property& column : columns)
                       append_value(bytes, column.value(i), column.type, format);
                   if (options.ascii) bytes.back() = '\n';
               });
    file.commit();
}

}  // namespace detail

/// Writes points and properties to the PCD file `path` atomically: an existing file is replaced or
/// stays unchanged. Fields are those of PCL: nx, ny, nz become normal_x, normal_y, normal_z; an
/// int32 "label" becomes uint32, with 4294967295 for -1 (`labels_of` reads both); red, green, blue
/// of eight bits become one field "rgb", which `read_pcd` takes apart again.
/// @param path        name of the file
/// @param points      any point range [m]; NaN is written. The member `width` of an organized image
///                    (`scan`) is kept. A single viewpoint becomes VIEWPOINT; several become fields
///                    viewpoint_x, viewpoint_y, viewpoint_z
/// @param columns     properties of the points in addition to x, y, z
/// @param options     encoding, and type of the coordinates
/// @param projection  maps an element of the range to a point
/// @throws gnomon::error          with the operating system's message, e.g. if the disk is full
/// @throws std::invalid_argument  if float32 coordinates, which the default is, would be off by
///                                more than 1 mm (beyond 16 km); if the points are not whole rows
///                                of their width; and as `write_ply`
/// Complexity: O(points * properties).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
void write_pcd(const std::string& path, const R& points, const properties& columns = {},
               const pcd_options& options = {}, Proj projection = {}) {
    const position_view<R, Proj> positions(points, std::move(projection));
    const viewpoint_table viewpoints = gnomon::detail::viewpoints_of(points);
    std::size_t width = 0;
    if constexpr (requires { static_cast<std::size_t>(points.width); })
        width = static_cast<std::size_t>(points.width);
    detail::write_pcd_rows(
        path, positions.size(), width, [&positions](std::size_t i) { return positions[i]; },
        viewpoints,
        detail::pcl_properties(
            detail::with_viewpoint_columns(columns, viewpoints, positions.size()),
            field_type::uint32),
        options);
}

}  // namespace gnomon::io
