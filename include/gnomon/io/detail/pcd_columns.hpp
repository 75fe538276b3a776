// SPDX-License-Identifier: BSL-1.0
/// @file
/// The columns of a PCD file. A color is packed into one field of four bytes, "rgb" or "rgba",
/// often declared as a float; it is read as the columns red, green, blue and, of "rgba", alpha as
/// well.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/io/detail/pcd_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io::detail {

/// A byte of the value of another column.
struct pcd_color {
    std::size_t source;  // the column
    std::size_t byte;    // 0 is the lowest
};

/// The columns: values of the file, then bytes of these. (Its functions are templates, so that
/// unused readers cost no compile time.)
struct pcd_table {
    std::vector<file_column> columns;  // "x" for a field of one value, "fpfh[0]", ... for several
    std::vector<scalar_layout> types;  // of the values
    std::vector<pcd_color> colors;     // the last columns

    /// @param header       a pcd_header
    /// @param with_colors  whether to unpack them, which takes time
    pcd_table(const auto& header, bool with_colors) {
        std::vector<std::pair<std::size_t, std::size_t>> packed;  // column, number of bytes
        for (const pcd_field& field : header.fields) {
            const bool is_packed = with_colors && field.size() == 4 && field.count == 1 &&
                                   (field.name == "rgb" || field.name == "rgba");
            if (is_packed) packed.emplace_back(columns.size(), field.name.size());
            for (std::size_t k = 0; k < field.count; ++k) {
                const bool is_single = field.count == 1 || field.name == "_";
                columns.push_back(
                    {is_single ? field.name : field.name + "[" + std::to_string(k) + "]",
                     field_type_of(field.type), !is_packed});
                types.push_back(field.type);
            }
        }
        constexpr std::array<std::pair<const char*, std::size_t>, 4> channels = {
            {{"red", 2}, {"green", 1}, {"blue", 0}, {"alpha", 3}}};
        for (const auto& [source, count] : packed) {
            for (std::size_t k = 0; k < count; ++k) {
                columns.push_back({channels[k].first, field_type::uint8});
                colors.push_back({source, channels[k].second});
            }
        }
    }

    /// Appends the bytes to the values of a point that were read from text. What the text of a
    /// float cannot hold (the bits of a NaN) becomes black.
    void append_colors(auto& row) const {
        for (const pcd_color& c : colors) {
            const double value = row[c.source];
            std::uint32_t bits = 0;
            if (types[c.source].kind == 'F')
                bits = std::isfinite(value) ? std::bit_cast<std::uint32_t>(to_float(value)) : 0;
            else if (std::abs(value) <= 0xffffffffU)
                bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(value));
            row.push_back((bits >> (8 * c.byte)) & 0xffU);
        }
    }

  private:
    [[nodiscard]] static float to_float(double value) {
        constexpr double most = std::numeric_limits<float>::max();
        return static_cast<float>(std::clamp(value, -most, most));
    }
};

}  // namespace gnomon::io::detail
