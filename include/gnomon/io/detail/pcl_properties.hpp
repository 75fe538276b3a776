// SPDX-License-Identifier: BSL-1.0
/// @file
/// Properties under the names that PCL and ROS have for them, and coordinates as floats.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io::detail {

/// The same columns with nx, ny, nz as normal_x, normal_y, normal_z, an int32 "label" as uint32 (-1
/// is 4294967295), and with red, green, blue, if all are there in eight bits, as one column "rgb",
/// the last one.
/// @param color  the type of the packed color, uint32 or float32 of the same bits
template <class = void>  // a template, so that unused writers cost no compile time
[[nodiscard]] properties pcl_properties(const properties& columns, field_type color) {
    constexpr std::array<std::array<std::string_view, 2>, 3> renamed = {
        {{"nx", "normal_x"}, {"ny", "normal_y"}, {"nz", "normal_z"}}};
    constexpr std::array<std::string_view, 3> channels = {"red", "green", "blue"};

    std::vector<const property*> packed;
    for (const std::string_view channel : channels)
        for (const property& column : columns)
            if (column.name == channel && column.type == field_type::uint8)
                packed.push_back(&column);
    const bool has_color = packed.size() == channels.size();

    std::vector<property> result;
    for (const property& column : columns) {
        if (has_color && std::find(packed.begin(), packed.end(), &column) != packed.end()) continue;
        result.push_back(column);
        for (const auto& [from, to] : renamed)
            if (column.name == from) result.back().name = to;
        if (column.name == "label" && column.type == field_type::int32) {
            result.back().type = field_type::uint32;
            result.back().value = [label = column.value](std::size_t i) -> double {
                return static_cast<std::uint32_t>(static_cast<std::int32_t>(label(i)));
            };
        }
    }
    if (has_color) {
        const auto bits = [red = packed[0]->value, green = packed[1]->value,
                           blue = packed[2]->value, color](std::size_t i) {
            const auto all = (static_cast<std::uint32_t>(red(i)) << 16U) |
                             (static_cast<std::uint32_t>(green(i)) << 8U) |
                             static_cast<std::uint32_t>(blue(i));
            return color == field_type::uint32 ? static_cast<double>(all)
                                               : static_cast<double>(std::bit_cast<float>(all));
        };
        result.push_back({"rgb", color, packed[0]->size, bits});
    }
    return properties(std::move(result));
}

/// Appends a coordinate, of which PCL and ROS expect a float.
/// @throws std::invalid_argument  if a float moves it by more than 1 mm
template <class = void>
void append_coordinate(std::string& bytes, double value, field_type type, ply_format format) {
    constexpr double max_shift = 1e-3;  // [m], below the noise of range finders
    double shift = 0.0;
    if (type == field_type::float32)
        shift = std::abs(static_cast<double>(narrowed<float>(value)) - value);
    gnomon::detail::require(!(shift > max_shift),
                            "float32 moves a coordinate by more than 1 mm: write float64, or "
                            "subtract an origin");
    append_value(bytes, value, type, format);
}

}  // namespace gnomon::io::detail
