// SPDX-License-Identifier: BSL-1.0
/// @file
/// The columns of the points of a LAS file: the attributes of its point format, and the extra bytes
/// that a record of the file describes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/io/detail/las_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io::detail {

/// The place of a value in a point: offset + scale * number, of a number or of some of its bits.
struct las_place {
    scalar_layout type;
    std::size_t first;       // byte in the point
    unsigned shift = 0;      // of the bits
    unsigned bits = 0;       // 0: all
    bool is_scaled = false;  // else scale and offset are not applied
    double scale = 1.0;
    double offset = 0.0;
};

/// An attribute of the point formats.
struct las_attribute {
    std::string_view name;
    las_place place;
};

/// A column of a file.
struct las_column {
    std::string name;  // "_" is padding
    field_type type;
    bool in_all;
    las_place place;
};

/// The attributes of formats 0 to 5 but for times and colors. The scan angle is in degrees.
inline constexpr std::array<las_attribute, 12> las_old_attributes = {{
    {"intensity", {{'U', 2}, 12}},
    {"return_number", {{'U', 1}, 14, 0, 3}},
    {"number_of_returns", {{'U', 1}, 14, 3, 3}},
    {"scan_direction_flag", {{'U', 1}, 14, 6, 1}},
    {"edge_of_flight_line", {{'U', 1}, 14, 7, 1}},
    {"classification", {{'U', 1}, 15, 0, 5}},
    {"synthetic", {{'U', 1}, 15, 5, 1}},
    {"key_point", {{'U', 1}, 15, 6, 1}},
    {"withheld", {{'U', 1}, 15, 7, 1}},
    {"scan_angle", {{'I', 1}, 16}},
    {"user_data", {{'U', 1}, 17}},
    {"point_source_id", {{'U', 2}, 18}},
}};

/// The attributes of formats 6 to 10 but for colors. The scan angle is in degrees.
inline constexpr std::array<las_attribute, 15> las_new_attributes = {{
    {"intensity", {{'U', 2}, 12}},
    {"return_number", {{'U', 1}, 14, 0, 4}},
    {"number_of_returns", {{'U', 1}, 14, 4, 4}},
    {"scan_direction_flag", {{'U', 1}, 15, 6, 1}},
    {"edge_of_flight_line", {{'U', 1}, 15, 7, 1}},
    {"classification", {{'U', 1}, 16}},
    {"synthetic", {{'U', 1}, 15, 0, 1}},
    {"key_point", {{'U', 1}, 15, 1, 1}},
    {"withheld", {{'U', 1}, 15, 2, 1}},
    {"overlap", {{'U', 1}, 15, 3, 1}},
    {"scanner_channel", {{'U', 1}, 15, 4, 2}},
    {"scan_angle", {{'I', 2}, 18, 0, 0, true, 0.006}},
    {"user_data", {{'U', 1}, 17}},
    {"point_source_id", {{'U', 2}, 20}},
    {"gps_time", {{'F', 8}, 22}},
}};

/// Bytes of the time of formats below 6, and of the first color; 0 where a format has none.
inline constexpr std::array<std::size_t, 11> las_times = {0, 20, 0, 20, 20, 20};
inline constexpr std::array<std::size_t, 11> las_colors = {0, 0, 20, 28, 0, 28, 0, 30, 30, 0, 30};

/// The names of the colors, each of 16 bits; the last one is infrared, of formats 8 and 10.
inline constexpr std::array<std::string_view, 4> las_color_names = {"red", "green", "blue", "nir"};

/// The types of extra bytes, 1 to 10. (11 to 30 are arrays of two and three of these.)
inline constexpr std::array<scalar_layout, 10> las_extra_types = {{{'U', 1},
                                                                   {'I', 1},
                                                                   {'U', 2},
                                                                   {'I', 2},
                                                                   {'U', 4},
                                                                   {'I', 4},
                                                                   {'U', 8},
                                                                   {'I', 8},
                                                                   {'F', 4},
                                                                   {'F', 8}}};

/// The attributes of a point format in addition to the coordinates.
template <class = void>  // templates, so that unused readers cost no compile time
[[nodiscard]] std::vector<las_attribute> las_attributes(unsigned format) {
    std::vector<las_attribute> result;
    if (format < 6)
        result.assign(las_old_attributes.begin(), las_old_attributes.end());
    else
        result.assign(las_new_attributes.begin(), las_new_attributes.end());
    if (las_times[format] != 0) result.push_back({"gps_time", {{'F', 8}, las_times[format]}});
    const std::size_t colors = las_colors[format] == 0 ? 0 : format == 8 || format == 10 ? 4 : 3;
    for (std::size_t k = 0; k < colors; ++k)
        result.push_back({las_color_names[k], {{'U', 2}, las_colors[format] + 2 * k}});
    return result;
}

/// The column of a place.
template <class = void>
[[nodiscard]] las_column las_column_of(std::string name, const las_place& place) {
    const field_type type = place.is_scaled ? field_type::float64 : field_type_of(place.type);
    return {std::move(name), type, true, place};
}

/// Appends the columns of the extra bytes that a record of the file describes.
/// @throws gnomon::error  if they are longer than a point, or of an unknown type
template <class = void>
void add_las_extra_columns(const input& file, const las_header& header,
                           std::vector<las_column>& columns) {
    constexpr std::size_t description = 192;
    const auto found =
        std::find_if(header.records.begin(), header.records.end(),
                     [](const las_record& r) { return r.user == "LASF_Spec" && r.id == 4; });
    if (found == header.records.end()) return;
    const las_bytes bytes(file);
    const auto start = static_cast<std::size_t>(found->data.data() - file.bytes.data());
    std::size_t place = las_point_sizes[header.format];
    for (std::size_t k = 0; k < found->data.size() / description; ++k) {
        const std::size_t at = start + k * description;
        const std::size_t code = bytes.number<std::uint8_t>(at + 2);
        const unsigned options = bytes.number<std::uint8_t>(at + 3);
        if (code > 3 * las_extra_types.size())
            bytes.fail(at + 2, "there is no type " + std::to_string(code) + " of extra bytes");
        const std::string_view text = bytes.text(at + 4, 32);
        const std::string name(text.substr(0, text.find('\0')));
        // Type 0: bytes without a meaning, as many as the options.
        const scalar_layout type = code == 0 ? scalar_layout{'U', 1}
                                             : las_extra_types[(code - 1) % las_extra_types.size()];
        const std::size_t count = code == 0 ? options : (code - 1) / las_extra_types.size() + 1;
        if (count * type.size > header.stride - place)
            bytes.fail(at, "the extra bytes are longer than a point");
        for (std::size_t i = 0; i < count && code != 0; ++i) {
            const bool scaled = (options & 8U) != 0, moved = (options & 16U) != 0;
            columns.push_back(
                las_column_of(name.empty() ? "_"
                              : count == 1 ? name
                                           : name + "[" + std::to_string(i) + "]",
                              {type, place + i * type.size, 0, 0, scaled || moved,
                               scaled ? bytes.number<double>(at + 112 + 8 * i) : 1.0,
                               moved ? bytes.number<double>(at + 136 + 8 * i) : 0.0}));
        }
        place += count * type.size;
    }
}

/// All columns of a file: first x, y and z.
template <class = void>
[[nodiscard]] std::vector<las_column> las_columns(const input& file, const las_header& header) {
    std::vector<las_column> result;
    for (std::size_t k = 0; k < 3; ++k)
        result.push_back(
            las_column_of(std::string(1, "xyz"[k]),
                          {{'I', 4}, 4 * k, 0, 0, true, header.scale[k], header.offset[k]}));
    for (const las_attribute& a : las_attributes(header.format))
        result.push_back(las_column_of(std::string(a.name), a.place));
    add_las_extra_columns(file, header, result);
    return result;
}

/// The value of a column in a point.
[[nodiscard]] inline double las_value(const char* point, const las_place& place) {
    const double number = decode(point + place.first, place.type, std::endian::little);
    if (place.bits != 0) {
        const unsigned all = static_cast<unsigned>(number) >> place.shift;
        return all & ((1U << place.bits) - 1U);
    }
    return place.is_scaled ? place.scale * number + place.offset : number;
}

}  // namespace gnomon::io::detail
