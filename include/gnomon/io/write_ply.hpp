// SPDX-License-Identifier: BSL-1.0
/// @file
/// Writes points and their properties to a PLY file (Turk 1994).
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
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

/// Appends `value` and a blank. Floating-point numbers have the fewest digits that are read back
/// exactly.
template <class T>
void append_text(std::string& text, T value) {
    char digits[32];
    if constexpr (std::is_floating_point_v<T>) {
        if (std::isnan(value)) value = std::numeric_limits<T>::quiet_NaN();  // without sign
    }
    const auto [end, problem] = std::to_chars(digits, digits + sizeof digits, value);
    static_cast<void>(problem);  // the longest double has 24 characters
    text.append(digits, end) += ' ';
}

/// Converts `value` to T. A conversion to float is rounded.
/// @throws std::invalid_argument  if `value` is outside the range of T, or not integral as T is
template <class T>
[[nodiscard]] T narrowed(double value) {
    using limits = std::numeric_limits<T>;
    bool fits = true;
    if constexpr (std::is_integral_v<T>) {
        fits = value >= static_cast<double>(limits::min()) &&
               value <= static_cast<double>(limits::max()) && value == std::trunc(value);
    } else {
        fits = !(std::isfinite(value) && std::abs(value) > static_cast<double>(limits::max()));
    }
    gnomon::detail::require(fits, "write_ply: a value does not fit the type of its property");
    return static_cast<T>(value);
}

/// Appends one value of a row in the encoding of the file.
template <class = void>  // templates, so that unused writers cost no compile time
void append_value(std::string& bytes, double value, field_type type, ply_format format) {
    visit_type(ply_type_of(type).layout, [&](auto zero) {
        const auto number = narrowed<decltype(zero)>(value);
        if (format == ply_format::ascii)
            append_text(bytes, number);
        else
            encode(
                bytes, number,
                format == ply_format::binary_big_endian ? std::endian::big : std::endian::little);
    });
}

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
    std::vector<std::string> names{"x", "y", "z"};
    for (const property& column : columns) {
        require(std::find(names.begin(), names.end(), column.name) == names.end(),
                "write_ply: two properties of one name");
        names.push_back(column.name);
        require(column.size == points, "write_ply: a property is for another number of points");
        require(!column.name.empty() && column.name.find_first_of(blanks) == std::string::npos,
                "write_ply: the name of a property must be one word");
    }

    output_file file(path);
    std::string bytes = ply_header_text(points, viewpoints, columns, options);
    constexpr std::size_t chunk = 1 << 16;
    for (std::size_t i = 0; i < points; ++i) {
        for (const double coordinate : position_of(i))
            append_value(bytes, coordinate, options.coordinates, options.format);
        for (const property& column : columns)
            append_value(bytes, column.value(i), column.type, options.format);
        if (options.format == ply_format::ascii) bytes.back() = '\n';
        if (bytes.size() >= chunk) {
            file.write(bytes);
            bytes.clear();
        }
    }
    file.write(bytes);
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
    properties all = columns;
    if (viewpoints.positions().size() > 1) {
        all = {columns, detail::three_properties({"viewpoint_x", "viewpoint_y", "viewpoint_z"},
                                                 field_type::float64, positions.size(),
                                                 [&](std::size_t i) { return viewpoints[i]; })};
    }
    detail::write_ply_rows(
        path, positions.size(), [&positions](std::size_t i) { return positions[i]; }, viewpoints,
        all, options);
}

}  // namespace gnomon::io
