// SPDX-License-Identifier: BSL-1.0
/// @file
/// The bytes of a LAS 1.4 file: its header, its records and its points (ASPRS, LAS Specification
/// 1.4 - R15, 2019).
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

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/detail/las_columns.hpp>
#include <gnomon/io/detail/las_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io::detail {

/// Appends little-endian numbers.
template <class... T>
void append_numbers(std::string& bytes, T... numbers) {
    (encode(bytes, numbers, std::endian::little), ...);
}

/// Appends a text and zeros up to `size` bytes.
template <class = void>  // templates, so that unused writers cost no compile time
void append_filled(std::string& bytes, std::string_view text, std::size_t size) {
    bytes += text;
    bytes.append(size - text.size(), '\0');
}

/// Appends a variable length record.
/// @throws std::invalid_argument  if it is too long for one
template <class = void>
void append_las_record(std::string& bytes, std::string_view user, std::uint16_t id,
                       std::string_view data) {
    gnomon::detail::require(data.size() <= 0xffffU,
                            "write_las: more data than a variable length record can hold");
    append_numbers(bytes, std::uint16_t{0});
    append_filled(bytes, user, 16);
    append_numbers(bytes, id, static_cast<std::uint16_t>(data.size()));
    append_filled(bytes, "", 32);
    bytes += data;
}

/// Replaces a value of a point, scaled and rounded.
/// @throws std::invalid_argument  if it does not fit its place
template <class = void>
void put_las_value(std::string& point, double value, const las_place& place) {
    const double number =
        place.is_scaled ? std::round((value - place.offset) / place.scale) : value;
    if (place.bits != 0) {
        const auto n = narrowed<std::uint8_t>(number);
        const unsigned mask = (1U << place.bits) - 1U;
        gnomon::detail::require(n <= mask,
                                "properties: a value does not fit the bits that LAS has for it");
        const auto others = static_cast<unsigned char>(point[place.first]) & ~(mask << place.shift);
        point[place.first] = static_cast<char>(others | (unsigned{n} << place.shift));
        return;
    }
    std::string bytes;
    visit_type(place.type, [&](auto zero) {
        encode(bytes, narrowed<decltype(zero)>(number), std::endian::little);
    });
    point.replace(place.first, bytes.size(), bytes);
}

/// The columns of the file: places of the coordinates, and of each property.
struct las_table {
    struct written {
        const property* column;
        las_place place;
        double factor;  // 257 for colors of eight bits, which have sixteen in LAS
    };

    unsigned format = 6;
    std::array<las_place, 3> axes;
    std::vector<written> columns;
    std::size_t stride = 0;
    std::string extra_bytes;  // the record that describes them
};

/// Finds the places of properties: attributes of the point format by their names, the others as
/// extra bytes. Refers to the properties.
/// @throws std::invalid_argument  if there are too many, or a name is too long
template <class = void>
[[nodiscard]] las_table las_table_of(const properties& columns, const std::array<double, 3>& scale,
                                     const std::array<double, 3>& offset) {
    las_table result;
    for (const property& column : columns)
        for (std::size_t k = 0; k < las_color_names.size(); ++k)
            if (column.name == las_color_names[k])
                result.format = std::max(result.format, k == 3 ? 8U : 7U);
    for (std::size_t k = 0; k < 3; ++k)
        result.axes[k] = {{'I', 4}, 4 * k, 0, 0, true, scale[k], offset[k]};
    result.stride = las_point_sizes[result.format];

    const std::vector<las_attribute> attributes = las_attributes(result.format);
    for (const property& column : columns) {
        const auto found = std::find_if(
            attributes.begin(), attributes.end(),
            [&column](const las_attribute& attribute) { return attribute.name == column.name; });
        if (found != attributes.end()) {
            const bool is_color = std::find(las_color_names.begin(), las_color_names.end(),
                                            column.name) != las_color_names.end();
            const bool widened = is_color && column.type == field_type::uint8;
            result.columns.push_back({&column, found->place, widened ? 257.0 : 1.0});
            continue;
        }
        const scalar_layout type = ply_type_of(column.type).layout;
        const auto code = std::find(las_extra_types.begin(), las_extra_types.end(), type) -
                          las_extra_types.begin() + 1;
        gnomon::detail::require(column.name.size() <= 32,
                                "write_las: the name of a property has more than 32 bytes");
        append_numbers(result.extra_bytes, std::uint16_t{0}, static_cast<std::uint8_t>(code),
                       std::uint8_t{0});
        append_filled(result.extra_bytes, column.name, 32);
        append_filled(result.extra_bytes, "", 156);  // no limits, no scale, no description
        result.columns.push_back({&column, {type, result.stride}, 1.0});
        result.stride += type.size;
    }
    gnomon::detail::require(result.stride <= 0xffffU, "write_las: too many properties");
    return result;
}

/// What the points have in common, of those that are written.
struct las_summary {
    std::uint64_t points = 0;
    std::array<std::uint64_t, 15> by_return{};
    Eigen::Vector3d lowest = Eigen::Vector3d::Zero(), highest = Eigen::Vector3d::Zero();
};

/// The header and its records.
/// @param records   encoded
/// @param count     number of records
/// @param encoding  the global encoding
template <class = void>
[[nodiscard]] std::string las_header_bytes(const las_table& table, const las_summary& all,
                                           const std::string& records, std::uint32_t count,
                                           std::uint16_t encoding) {
    constexpr std::uint16_t size = las_header_sizes[4];
    std::string bytes = "LASF";
    append_numbers(bytes, std::uint16_t{0}, encoding);
    append_filled(bytes, "", 16);
    append_numbers(bytes, std::uint8_t{1}, std::uint8_t{4});
    append_filled(bytes, "OTHER", 32);
    append_filled(bytes, "gnomon", 32);
    // Without a date: the same points give the same bytes.
    append_numbers(bytes, std::uint16_t{0}, std::uint16_t{0}, size,
                   static_cast<std::uint32_t>(size + records.size()), count,
                   static_cast<std::uint8_t>(table.format),
                   static_cast<std::uint16_t>(table.stride));
    append_filled(bytes, "", 24);  // the counts of old versions
    for (const las_place& axis : table.axes) append_numbers(bytes, axis.scale);
    for (const las_place& axis : table.axes) append_numbers(bytes, axis.offset);
    for (Eigen::Index k = 0; k < 3; ++k) append_numbers(bytes, all.highest[k], all.lowest[k]);
    // No waveforms, no extended records.
    append_numbers(bytes, std::uint64_t{0}, std::uint64_t{0}, std::uint32_t{0}, all.points);
    for (const std::uint64_t n : all.by_return) append_numbers(bytes, n);
    return bytes + records;
}

}  // namespace gnomon::io::detail
