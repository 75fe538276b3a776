// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads LAS files of airborne and terrestrial laser scanners (ASPRS): versions 1.0 to 1.4, point
/// formats 0 to 10, not compressed. Where this header is included, `read` reads LAS files too.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/byte_cursor.hpp>
#include <gnomon/io/detail/las_columns.hpp>
#include <gnomon/io/detail/las_header.hpp>
#include <gnomon/io/detail/las_reader.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io {
namespace detail {

/// The viewpoint in the record that `write_las` writes; none without it.
template <class = void>
[[nodiscard]] viewpoint_table las_viewpoint(const las_header& header) {
    constexpr std::size_t size = sizeof(double);
    for (const las_record& r : header.records) {
        if (r.user != las_own_user || r.id != las_viewpoint_id || r.data.size() != 3 * size)
            continue;
        Eigen::Vector3d position;
        for (std::size_t k = 0; k < 3; ++k)
            position[static_cast<Eigen::Index>(k)] =
                decode(r.data.data() + k * size, {'F', size}, std::endian::little);
        return position;
    }
    return {};
}

}  // namespace detail

/// Parses a LAS file. Coordinates are offset + scale * number, in double. Further columns, of those
/// that the point format has: "intensity", "return_number", "number_of_returns",
/// "scan_direction_flag", "edge_of_flight_line", "classification", "synthetic", "key_point",
/// "withheld", "overlap", "scanner_channel", "scan_angle" [degrees], "user_data",
/// "point_source_id", "gps_time" [s], "red", "green", "blue", "nir" (16 bits each), and the extra
/// bytes by their names, scaled. Withheld points are points. Waveforms (formats 4, 5, 9 and 10) are
/// left out, and so are coordinate reference systems; `write_las` can copy these.
/// @param file    name and contents of the file
/// @param fields  names of further columns that become fields; "*" stands for all
/// @return the points in the order of the file, in its unit of length, with fields, and with the
///         viewpoints of files that `write_las` wrote
/// @throws gnomon::error  if the file is damaged, compressed (LAZ) or of a later version, or if a
///                        field is missing
/// Complexity: O(bytes).
template <class = void>  // a template, so that unused readers cost no compile time
[[nodiscard]] scan read_las(const input& file, const std::vector<std::string>& fields = {}) {
    const auto header = detail::read_las_header(file);
    auto columns = detail::las_columns(file, header);
    detail::byte_cursor bytes(file, header.points_at);
    detail::scan_builder builder(columns, fields, bytes);

    // Without fields, attributes are not decoded; extra bytes can be viewpoints.
    const std::size_t standard = 3 + detail::las_attributes(header.format).size();
    if (fields.empty() && columns.size() == standard) columns.resize(3);
    const auto points = static_cast<std::size_t>(header.points);
    builder.reserve(points);
    std::vector<double> row(columns.size());
    for (std::size_t i = 0; i < points; ++i) {
        const char* const point = bytes.take(header.stride).data();
        std::transform(columns.begin(), columns.end(), row.begin(), [point](const auto& column) {
            return detail::las_value(point, column.place);
        });
        builder.add(row);
    }
    return std::move(builder).finish(detail::las_viewpoint(header));
}

namespace detail {

/// Enters the reader before main.
inline const bool las_is_read = (las_reader = &read_las<void>) != nullptr;

}  // namespace detail

}  // namespace gnomon::io
