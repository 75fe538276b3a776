// SPDX-License-Identifier: BSL-1.0
/// @file
/// The memory of a message sensor_msgs/PointCloud2: where its points and fields are, checked once,
/// and the same written.
#pragma once

#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/exceptions.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/detail/pcl_properties.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::detail {

/// A class with the members of sensor_msgs/PointCloud2.
template <class M>
concept point_cloud2_message = requires(M m) {
    { m.height } -> std::convertible_to<std::uint32_t>;
    { m.width } -> std::convertible_to<std::uint32_t>;
    { m.fields.empty() } -> std::convertible_to<bool>;
    { m.fields[0].name } -> std::convertible_to<std::string>;
    { m.fields[0].offset } -> std::convertible_to<std::uint32_t>;
    { m.fields[0].datatype } -> std::convertible_to<std::uint8_t>;
    { m.fields[0].count } -> std::convertible_to<std::uint32_t>;
    { m.is_bigendian } -> std::convertible_to<bool>;
    { m.point_step } -> std::convertible_to<std::uint32_t>;
    { m.row_step } -> std::convertible_to<std::uint32_t>;
    { m.data[0] } -> std::convertible_to<std::uint8_t>;
    { m.is_dense } -> std::convertible_to<bool>;
};

/// Throws an error about a field.
[[noreturn]] inline void fail_cloud2(const std::string& field, const std::string& message) {
    GNOMON_THROW(error("PointCloud2", field.empty() ? "" : "field \"" + field + "\"", message));
}

/// Where `scan_builder` reports errors.
struct cloud2_errors {
    [[noreturn]] void fail(const std::string& message) const { fail_cloud2("", message); }
};

/// The type of a field. The numbers 1 to 8 of a message are int8, uint8, ... in the order of
/// `io::field_type`.
/// @throws gnomon::error  if there is no such type
[[nodiscard]] io::detail::scalar_layout cloud2_type(const auto& field) {
    const unsigned number = field.datatype;
    if (number < 1 || number > io::detail::ply_types.size())
        fail_cloud2(field.name, "there is no datatype " + std::to_string(number));
    return io::detail::ply_types[number - 1].layout;
}

/// The number of values of a field; some drivers write 0 for one.
[[nodiscard]] std::size_t cloud2_count(const auto& field) {
    return field.count == 0 ? 1 : static_cast<std::size_t>(field.count);
}

/// Whether a message was never filled: without fields, and without points.
[[nodiscard]] bool is_blank(const point_cloud2_message auto& m) {
    return m.fields.empty() && (m.width == 0 || m.height == 0);
}

/// The places of the points of a message; refers to its data.
struct cloud2_layout {
    const char* data = nullptr;
    std::size_t width = 0, height = 0, point_step = 0, row_step = 0;
    std::endian order = std::endian::little;

    /// @throws gnomon::error  if rows or data are shorter than the message declares
    explicit cloud2_layout(const point_cloud2_message auto& m)
        : width(m.width),
          height(m.height),
          point_step(m.point_step),
          row_step(m.row_step),
          order(m.is_bigendian ? std::endian::big : std::endian::little) {
        const std::size_t bytes = m.data.size();
        if (width == 0 || height == 0) {
            width = height = 0;
            return;
        }
        data = reinterpret_cast<const char*>(&m.data[0]);
        if (point_step == 0) fail_cloud2("", "point_step is 0");
        // In 64 bits: the factors have 32.
        const std::uint64_t row = std::uint64_t{width} * point_step;
        if (height > 1 && row_step < row)
            fail_cloud2("", "row_step is " + std::to_string(row_step) + ", but a row has " +
                                std::to_string(row) + " bytes");
        if (row > bytes || (height > 1 && (bytes - row) / row_step < height - 1))
            fail_cloud2("", "data has " + std::to_string(bytes) + " bytes, too few for " +
                                std::to_string(height) + " rows of " + std::to_string(row));
    }

    /// The first byte of point i.
    [[nodiscard]] const char* point(std::size_t i) const {
        return height == 1 || row_step == width * point_step
                   ? data + i * point_step
                   : data + i / width * row_step + i % width * point_step;
    }

    /// @throws gnomon::error  if a field reaches beyond its point
    void require_in_point(const auto& field, std::uint64_t size) const {
        if (field.offset > point_step || size > point_step - field.offset)
            fail_cloud2(field.name,
                        "reaches beyond point_step, which is " + std::to_string(point_step));
    }
};

/// The field `name`, which holds one value.
/// @throws gnomon::error  if it is missing, has several values or reaches beyond its point
[[nodiscard]] const auto& cloud2_field(const point_cloud2_message auto& m, std::string_view name) {
    std::string there;
    for (const auto& field : m.fields) {
        if (field.name == name) {
            if (cloud2_count(field) != 1) fail_cloud2(field.name, "has several values");
            cloud2_layout(m).require_in_point(field, cloud2_type(field).size);
            return field;
        }
        there += (there.empty() ? "" : ", ") + std::string(field.name);
    }
    fail_cloud2(std::string(name), "is missing; there are: " + there);
}

/// Fills a message. Its bytes are made first, so that an exception leaves it unchanged.
template <point_cloud2_message M>
void fill_cloud2(M& message, std::size_t points, std::size_t width,
                 const std::function<Eigen::Vector3d(std::size_t)>& position_of,
                 const io::properties& columns, io::field_type coordinates) {
    require(coordinates == io::field_type::float32 || coordinates == io::field_type::float64,
            "fill_point_cloud2: coordinates must be float32 or float64");
    require(width == 0 || points % width == 0,
            "fill_point_cloud2: the points are not whole rows of the width");
    io::detail::require_columns(columns, points);

    using fields_type = std::remove_cvref_t<decltype(message.fields)>;
    fields_type fields;
    std::size_t step = 0;
    const auto declare = [&](const std::string& name, io::field_type type) {
        typename fields_type::value_type field;
        field.name = name;
        field.offset = static_cast<std::uint32_t>(step);
        field.datatype = static_cast<std::uint8_t>(static_cast<unsigned>(type) + 1);
        field.count = 1;
        fields.push_back(std::move(field));
        step += io::detail::ply_type_of(type).layout.size;
    };
    for (const char* const axis : {"x", "y", "z"}) declare(axis, coordinates);
    for (const io::property& column : columns) declare(column.name, column.type);
    const std::size_t in_row = width == 0 ? points : width;
    require(std::uint64_t{in_row} * step <= std::numeric_limits<std::uint32_t>::max(),
            "fill_point_cloud2: a row of the message has more than 2^32 bytes");

    std::string bytes;
    bytes.reserve(points * step);
    bool is_dense = true;
    constexpr auto format = io::ply_format::binary_little_endian;
    for (std::size_t i = 0; i < points; ++i) {
        const Eigen::Vector3d p = position_of(i);
        is_dense = is_dense && is_finite(p);
        for (const double coordinate : p)
            io::detail::append_coordinate(bytes, coordinate, coordinates, format);
        for (const io::property& column : columns)
            io::detail::append_value(bytes, column.value(i), column.type, format);
    }
    message.data.assign(bytes.begin(), bytes.end());
    message.fields = std::move(fields);
    message.width = static_cast<std::uint32_t>(in_row);
    message.height = static_cast<std::uint32_t>(in_row == 0 ? 1 : points / in_row);
    message.is_bigendian = false;
    message.point_step = static_cast<std::uint32_t>(step);
    message.row_step = static_cast<std::uint32_t>(in_row * step);
    message.is_dense = is_dense;
}

}  // namespace gnomon::detail
