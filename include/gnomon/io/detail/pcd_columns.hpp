// SPDX-License-Identifier: BSL-1.0
/// @file
/// The columns of a PCD file. A color is packed into one field of four bytes, "rgb" or "rgba",
/// often declared as a float; it is read as the columns red, green, blue and, of "rgba", alpha as
/// well.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/io/detail/pcd_header.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/detail/scan_builder.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io::detail {

/// The columns: values of the file, then bytes of these. (A template with members that depend on
/// its argument, so that unused readers cost no compile time.)
/// @tparam Column  a file_column
template <class Column = file_column>
struct pcd_table {
    /// A byte of the value of another column.
    struct color {
        std::size_t source;  // the column
        std::size_t byte;    // 0 is the lowest
        bool is_of_float;
    };

    std::vector<Column> columns;  // "x" for a field of one value, "fpfh[0]", ... for several
    std::vector<color> colors;    // the last columns

    /// @param header       a pcd_header
    /// @param with_colors  whether to unpack them, which takes time
    pcd_table(const auto& header, bool with_colors) {
        std::vector<color> packed;  // how many bytes of a column, not which
        for (const auto& field : header.fields) {
            const bool is_packed = with_colors && field.size() == 4 && field.count == 1 &&
                                   (field.name == "rgb" || field.name == "rgba");
            if (is_packed)
                packed.push_back({columns.size(), field.name.size(), field.type.kind == 'F'});
            for (std::size_t k = 0; k < field.count; ++k) {
                const bool is_single = field.count == 1 || field.name == "_";
                columns.push_back(
                    {is_single ? field.name : field.name + "[" + std::to_string(k) + "]",
                     field_type_of(field.type), !is_packed});
            }
        }
        constexpr const char* channels[] = {"red", "green", "blue", "alpha"};
        constexpr std::size_t bytes[] = {2, 1, 0, 3};  // of these
        for (const color& source : packed) {
            for (std::size_t k = 0; k < source.byte; ++k) {
                columns.push_back({channels[k], field_type::uint8});
                colors.push_back({source.source, bytes[k], source.is_of_float});
            }
        }
    }

    /// The number of values of a point in the file.
    [[nodiscard]] std::size_t values() const { return columns.size() - colors.size(); }

    /// Appends the bytes to the values of a point that were read from text. What the text of a
    /// float cannot hold (the bits of a NaN) becomes black.
    void append_colors(std::vector<double>& row) const {
        for (const color& c : colors) {
            const double value = row[c.source];
            std::uint32_t bits = 0;
            if (c.is_of_float)
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
