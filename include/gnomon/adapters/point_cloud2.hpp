// SPDX-License-Identifier: BSL-1.0
/// @file
/// Messages sensor_msgs/PointCloud2 of ROS 1 and ROS 2: their points without a copy, their fields
/// as a scan, and results as a message. Needs no header of ROS: everything is a template over the
/// type of the message.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/adapters/detail/cloud2_layout.hpp>
#include <gnomon/core/detail/index_iterator.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/detail/pcd_columns.hpp>
#include <gnomon/io/detail/pcl_properties.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/ply_format.hpp>
#include <gnomon/io/property.hpp>
#include <gnomon/io/read_pcd.hpp>

namespace gnomon {

/// The points of a message, by index; models `point_range`. Refers to the data of the message;
/// copies only the point that is accessed. Float or double, any byte order, padding between points
/// and rows.
class point_cloud2_view {
  public:
    /// @throws gnomon::error  if the message has no fields x, y, z of one floating-point type, or
    /// is
    ///                        shorter than it declares; see `point_cloud2_points`
    template <detail::point_cloud2_message M>
    explicit point_cloud2_view(const M& message) : layout_(message) {
        if (detail::is_blank(message)) return;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::string name(1, "xyz"[k]);
            const auto& field = detail::cloud2_field(message, name);
            type_ = detail::cloud2_type(field);
            offsets_[k] = field.offset;
            if (type_.kind != 'F' ||
                type_ != detail::cloud2_type(detail::cloud2_field(message, "x")))
                detail::fail_cloud2(name, "x, y and z must all be FLOAT32 or all be FLOAT64");
        }
        width = layout_.height > 1 ? layout_.width : 0;
    }

    /// The number of points.
    [[nodiscard]] std::size_t size() const { return layout_.width * layout_.height; }
    [[nodiscard]] auto begin() const { return detail::index_iterator(this, 0); }
    [[nodiscard]] auto end() const {
        return detail::index_iterator(this, static_cast<std::ptrdiff_t>(size()));
    }

    /// The coordinates of point i [m]. Precondition: i < size().
    [[nodiscard]] Eigen::Vector3d operator[](std::size_t i) const {
        const char* const point = layout_.point(i);
        return {io::detail::decode(point + offsets_[0], type_, layout_.order),
                io::detail::decode(point + offsets_[1], type_, layout_.order),
                io::detail::decode(point + offsets_[2], type_, layout_.order)};
    }

    /// The machine epsilon of the coordinates in the message.
    [[nodiscard]] double epsilon() const {
        return type_.size == sizeof(float)
                   ? static_cast<double>(std::numeric_limits<float>::epsilon())
                   : std::numeric_limits<double>::epsilon();
    }

    std::size_t width = 0;  ///< the width [pixels] of an organized image; else 0

  private:
    detail::cloud2_layout layout_;
    std::array<std::size_t, 3> offsets_{};
    io::detail::scalar_layout type_{'F', 4};
};

/// The points of a message, without a copy: a point range for every algorithm. Points are in the
/// frame of the message; if that is not the frame of the sensor, add `with_viewpoint(points, v)`.
/// The message must outlive the view. A message without fields and points has no points. O(fields).
/// @throws gnomon::error  if a field x, y or z is missing, is not a single FLOAT32 or FLOAT64 or
///                        reaches beyond `point_step`; if `row_step` is shorter than its points;
///                        or if `data` is shorter than all rows
template <detail::point_cloud2_message M>
[[nodiscard]] point_cloud2_view point_cloud2_points(const M& message) {
    return point_cloud2_view(message);
}
template <detail::point_cloud2_message M>
void point_cloud2_points(const M&& message) = delete;

/// A copy of the points and of some fields of a message.
/// @param fields  names of further fields, e.g. "intensity", or "name[0]" of several values; "red",
///                "green" and "blue" of a packed "rgb"; "*" stands for all
/// @return the points [m], with fields; `width` is set if the message has several rows
/// @throws gnomon::error  as `point_cloud2_points`, and if a field is missing
/// Complexity: O(bytes).
template <detail::point_cloud2_message M>
[[nodiscard]] scan point_cloud2_scan(const M& message,
                                     const std::vector<std::string>& fields = {}) {
    if (detail::is_blank(message)) return {};
    const point_cloud2_view points(message);
    const detail::cloud2_layout layout(message);
    io::detail::pcd_header header;
    std::vector<io::detail::pcd_column> places;
    for (const auto& field : message.fields) {
        const io::detail::scalar_layout type = detail::cloud2_type(field);
        const std::size_t count = detail::cloud2_count(field);
        layout.require_in_point(field, std::uint64_t{type.size} * count);
        header.fields.push_back({std::string(field.name), type, count});
        for (std::size_t k = 0; k < count; ++k)
            places.push_back({type, field.offset + k * type.size, 0});
    }
    const io::detail::pcd_table table(header, !fields.empty());
    for (const auto& c : table.colors) {
        const std::size_t low = layout.order == std::endian::little ? c.byte : 3 - c.byte;
        places.push_back({{'U', 1}, places[c.source].first + low, 0});
    }

    io::detail::scan_builder builder(table.columns, fields, detail::cloud2_errors{});
    builder.reserve(points.size());
    std::vector<double> row(places.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const char* const point = layout.point(i);
        std::transform(places.begin(), places.end(), row.begin(), [&](const auto& place) {
            return io::detail::decode(point + place.first, place.type, layout.order);
        });
        builder.add(row);
    }
    scan result = std::move(builder).finish();
    result.width = points.width;
    return result;
}

/// Fills a message with points and properties; its header, with frame and stamp, stays as it is.
/// Names are those of ROS and PCL: nx, ny, nz become normal_x, normal_y, normal_z; an int32 "label"
/// becomes uint32 (4294967295 for -1); red, green, blue of eight bits become one field "rgb".
///
///     fill_point_cloud2(out, points, {normal_properties(surface), label_properties(labels)});
///
/// @param message      any PointCloud2 message; unchanged if an exception is thrown
/// @param points       any point range [m]. NaN is written, and is_dense is false then. The member
///                     `width` of an organized image (`scan`) is kept
/// @param columns      properties of the points in addition to x, y, z
/// @param coordinates  type of x, y, z: float32, which nodes of ROS expect, or float64
/// @param projection   maps an element of the range to a point
/// @throws std::invalid_argument  if float32 coordinates would be off by more than 1 mm; for more
///                                bytes than a message can count; and as `write_ply`
/// Complexity: O(points * properties).
template <detail::point_cloud2_message M, class R, class Proj = std::identity>
    requires point_range<R, Proj>
void fill_point_cloud2(M& message, const R& points, const io::properties& columns = {},
                       io::field_type coordinates = io::field_type::float32, Proj projection = {}) {
    const position_view<R, Proj> positions(points, std::move(projection));
    const viewpoint_table viewpoints = detail::viewpoints_of(points);
    const io::properties all = io::detail::pcl_properties(
        io::detail::with_viewpoint_columns(columns, viewpoints, positions.size()),
        io::field_type::float32);
    std::size_t width = 0;
    if constexpr (requires { static_cast<std::size_t>(points.width); })
        width = static_cast<std::size_t>(points.width);
    detail::fill_cloud2(
        message, positions.size(), width, [&positions](std::size_t i) { return positions[i]; }, all,
        coordinates);
}

}  // namespace gnomon
