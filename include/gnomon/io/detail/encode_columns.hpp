// SPDX-License-Identifier: BSL-1.0
/// @file
/// Points and their properties as rows of a file, for all writers: checks of the properties, and
/// the encoding of numbers.
#pragma once

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io::detail {

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

/// @throws std::invalid_argument  which names the value and what the property holds
template <class T>
[[noreturn]] void refuse(double value) {
    std::string message = "properties: ";
    append_text(message, value);  // and a blank
    message += "does not fit its property, which holds ";
    message += std::is_integral_v<T> ? "whole numbers from " : "numbers from ";
    append_text(message, std::numeric_limits<T>::lowest());
    message += "to ";
    append_text(message, std::numeric_limits<T>::max());
    message.pop_back();
    GNOMON_THROW(std::invalid_argument(message));
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
    if (!fits) refuse<T>(value);
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

/// Checks properties in addition to x, y, z.
/// @throws std::invalid_argument  for a property for another number of points, or whose name is
///                                used twice or is not one word
template <class = void>
void require_columns(const properties& columns, std::size_t points) {
    using gnomon::detail::require;
    std::vector<std::string> names{"x", "y", "z"};
    for (const property& column : columns) {
        require(std::find(names.begin(), names.end(), column.name) == names.end(),
                "properties: two of one name");
        names.push_back(column.name);
        require(column.size == points, "properties: one is for another number of points");
        require(!column.name.empty() && column.name.find_first_of(blanks) == std::string::npos,
                "properties: a name must be one word");
    }
}

/// Appends several viewpoints as properties viewpoint_x, viewpoint_y, viewpoint_z. Refers to the
/// table.
template <class = void>
[[nodiscard]] properties with_viewpoint_columns(const properties& columns,
                                                const viewpoint_table& viewpoints,
                                                std::size_t points) {
    if (viewpoints.positions().size() <= 1) return columns;
    return {columns,
            three_properties({"viewpoint_x", "viewpoint_y", "viewpoint_z"}, field_type::float64,
                             points, [&viewpoints](std::size_t i) { return viewpoints[i]; })};
}

/// Writes the rows of n points, appended by append(bytes, i), after `bytes`.
void write_rows(output_file& file, std::string bytes, std::size_t points, const auto& append) {
    constexpr std::size_t chunk = 1 << 16;
    for (std::size_t i = 0; i < points; ++i) {
        append(bytes, i);
        if (bytes.size() < chunk) continue;
        file.write(bytes);
        bytes.clear();
    }
    file.write(bytes);
}

}  // namespace gnomon::io::detail
