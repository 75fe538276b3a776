// SPDX-License-Identifier: BSL-1.0
/// @file
/// Writes points and their properties to a LAS 1.4 file, not compressed. Labels become extra bytes,
/// which every reader of LAS 1.4 finds by their name.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/encode_columns.hpp>
#include <gnomon/io/detail/las_writer.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/output_file.hpp>
#include <gnomon/io/property.hpp>

namespace gnomon::io {

/// Options of `write_las`.
struct las_options {
    /// Distance of neighboring coordinates [m], which are integers in a LAS file. It is multiplied
    /// by powers of ten for points that are too far apart for 32 bits: at 0.1 mm more than 429 km.
    double resolution = 1e-4;
    /// Leave out points that are not finite, which LAS cannot hold; else they are refused.
    bool drop_missing = false;
    /// A LAS file whose coordinate reference system and kind of GPS time are copied, and its scale
    /// and offset where the points fit them: its own coordinates are then written exactly. Null:
    /// none.
    const input* source = nullptr;
};

namespace detail {

/// The points that are written, and their bounds.
struct las_selection {
    std::vector<std::size_t> points;
    Eigen::Vector3d lowest = Eigen::Vector3d::Zero(), highest = Eigen::Vector3d::Zero();
};

/// @throws std::invalid_argument  for a point that is not finite, unless these are dropped
template <class = void>  // templates, so that unused writers cost no compile time
[[nodiscard]] las_selection las_points_of(
    std::size_t points, const std::function<Eigen::Vector3d(std::size_t)>& position_of,
    bool drop_missing) {
    las_selection result;
    for (std::size_t i = 0; i < points; ++i) {
        const Eigen::Vector3d p = position_of(i);
        if (!is_finite(p)) {
            gnomon::detail::require(drop_missing,
                                    "write_las: a point is not finite, which LAS cannot hold: set "
                                    "drop_missing to leave out such points");
            continue;
        }
        result.lowest = result.points.empty() ? p : Eigen::Vector3d(result.lowest.cwiseMin(p));
        result.highest = result.points.empty() ? p : Eigen::Vector3d(result.highest.cwiseMax(p));
        result.points.push_back(i);
    }
    return result;
}

/// The scale and the offset of one axis, for coordinates from `lowest` to `highest`: the offset is
/// a whole number in their middle.
template <class = void>
[[nodiscard]] std::array<double, 2> las_scale(double lowest, double highest, double resolution) {
    constexpr double most = 2147483647.0;  // of 32 bits
    const double offset = std::round(lowest / 2 + highest / 2);
    const double reach = std::max(highest - offset, offset - lowest);
    double scale = resolution;
    while (reach / scale > most - 1) scale *= 10;
    return {scale, offset};
}

/// Whether numbers of 32 bits reach from `lowest` to `highest`.
[[nodiscard]] inline bool fits_las(double lowest, double highest, double scale, double offset) {
    constexpr double most = 2147483647.0;  // of 32 bits
    return std::abs((lowest - offset) / scale) < most - 1 &&
           std::abs((highest - offset) / scale) < most - 1;
}

/// The records of the file, and what of the source is not a record.
struct las_frame {
    std::array<double, 3> scale{}, offset{};
    std::uint16_t encoding = 0x10;  // coordinate reference systems are well-known text
    std::string records;
    std::uint32_t count = 0;

    void add(std::string_view user, std::uint16_t id, std::string_view data) {
        append_las_record(records, user, id, data);
        ++count;
    }
};

/// The frame of points within bounds.
/// @throws gnomon::error  if the source is not a LAS file
template <class = void>
[[nodiscard]] las_frame las_frame_of(const las_selection& chosen, const las_options& options) {
    las_frame result;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const auto [scale, offset] =
            las_scale(chosen.lowest[axis], chosen.highest[axis], options.resolution);
        result.scale[k] = scale;
        result.offset[k] = offset;
    }
    if (options.source == nullptr) return result;
    const las_header source = read_las_header(*options.source);
    bool fits = true;
    for (std::size_t k = 0; k < 3; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        fits = fits && fits_las(chosen.lowest[axis], chosen.highest[axis], source.scale[k],
                                source.offset[k]);
    }
    if (fits) {
        result.scale = source.scale;
        result.offset = source.offset;
    }
    bool has_geotiff = false;
    for (const las_record& record : source.records) {
        if (record.user != "LASF_Projection") continue;
        result.add(record.user, record.id, record.data);
        has_geotiff = has_geotiff || record.id == 34735;
    }
    constexpr std::uint16_t gps_time = 1, text = 0x10;
    result.encoding = static_cast<std::uint16_t>((source.encoding & (gps_time | text)) |
                                                 (has_geotiff ? 0 : text));
    return result;
}

/// Encodes point i.
template <class = void>
void put_las_point(std::string& point, const las_table& table, const Eigen::Vector3d& position,
                   std::size_t i) {
    point.assign(table.stride, '\0');
    point[14] = 0x11;  // the first of one return
    for (std::size_t k = 0; k < 3; ++k)
        put_las_value(point, position[static_cast<Eigen::Index>(k)], table.axes[k]);
    for (const las_table::written& w : table.columns)
        put_las_value(point, w.factor * w.column->value(i), w.place);
}

/// What the header contains about the points, as they are encoded.
template <class = void>
[[nodiscard]] las_summary las_summary_of(const las_table& table, const las_selection& chosen,
                                         const properties& columns) {
    las_summary result;
    result.points = chosen.points.size();
    const auto returns = std::find_if(columns.begin(), columns.end(), [](const property& column) {
        return column.name == "return_number";
    });
    for (const std::size_t i : chosen.points) {
        const double number = returns == columns.end() ? 1.0 : returns->value(i);
        if (number >= 1.0 && number <= 15.0)
            ++result.by_return[static_cast<std::size_t>(number) - 1];
    }
    for (std::size_t k = 0; k < 3 && result.points > 0; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        const las_place& place = table.axes[k];
        const auto encoded = [&place](double value) {
            return place.scale * std::round((value - place.offset) / place.scale) + place.offset;
        };
        result.lowest[axis] = encoded(chosen.lowest[axis]);
        result.highest[axis] = encoded(chosen.highest[axis]);
    }
    return result;
}

/// Writes the file. Independent of the type of the points, so that it is compiled once.
template <class = void>
void write_las_rows(const std::string& path, std::size_t points,
                    const std::function<Eigen::Vector3d(std::size_t)>& position_of,
                    const viewpoint_table& viewpoints, const properties& columns,
                    const las_options& options) {
    gnomon::detail::require(options.resolution > 0.0 && std::isfinite(options.resolution),
                            "write_las: the resolution must be positive");
    require_columns(columns, points);
    const las_selection chosen = las_points_of(points, position_of, options.drop_missing);
    las_frame frame = las_frame_of(chosen, options);
    const las_table table = las_table_of(columns, frame.scale, frame.offset);
    if (!table.extra_bytes.empty()) frame.add("LASF_Spec", 4, table.extra_bytes);
    if (viewpoints.positions().size() == 1) {
        std::string position;
        for (const double coordinate : viewpoints.positions().front())
            append_numbers(position, coordinate);
        frame.add(las_own_user, las_viewpoint_id, position);
    }

    output_file file(path);
    const las_summary all = las_summary_of(table, chosen, columns);
    std::string point;
    write_rows(file, las_header_bytes(table, all, frame.records, frame.count, frame.encoding),
               chosen.points.size(), [&](std::string& bytes, std::size_t k) {
                   const std::size_t i = chosen.points[k];
                   put_las_point(point, table, position_of(i), i);
                   bytes += point;
               });
    file.commit();
}

}  // namespace detail

/// Writes points and properties to the LAS file `path` atomically: an existing file is replaced or
/// stays unchanged. Properties of the names that `read_las` lists become the attributes of the
/// points, "classification" among them; all others, such as "label", "nx" or "ny", become extra
/// bytes of their type. Colors of eight bits are widened to sixteen. The point format is 6, with
/// colors 7, with infrared 8.
/// @param path        name of the file
/// @param points      any point range [m]. A single viewpoint becomes a record of the file, several
///                    become extra bytes viewpoint_x, viewpoint_y, viewpoint_z; `read_las` reads
///                    both
/// @param columns     properties of the points in addition to x, y, z
/// @param options     resolution, points that are not finite, and a file to copy the coordinate
///                    reference system from
/// @param projection  maps an element of the range to a point
/// @throws gnomon::error          with the operating system's message, or if options.source is not
///                                a plain LAS file
/// @throws std::invalid_argument  for a point that is not finite, unless these are dropped; if the
///                                resolution is not positive; if a property is for another number
///                                of points, its name is used twice, is not one word or has more
///                                than 32 bytes, or a value does not fit its type or attribute
/// Complexity: O(points * properties).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
void write_las(const std::string& path, const R& points, const properties& columns = {},
               const las_options& options = {}, Proj projection = {}) {
    const position_view<R, Proj> positions(points, std::move(projection));
    const viewpoint_table viewpoints = gnomon::detail::viewpoints_of(points);
    detail::write_las_rows(
        path, positions.size(), [&positions](std::size_t i) { return positions[i]; }, viewpoints,
        detail::with_viewpoint_columns(columns, viewpoints, positions.size()), options);
}

}  // namespace gnomon::io
