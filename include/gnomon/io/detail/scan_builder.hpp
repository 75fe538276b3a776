// SPDX-License-Identifier: BSL-1.0
/// @file
/// Assembles a scan from rows of numbers: selects the columns of the coordinates, of the viewpoint
/// and of the requested fields.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/ply_format.hpp>

namespace gnomon::io::detail {

/// A column of a file.
struct file_column {
    std::string name;  // "_" is padding
    field_type type = field_type::float64;
    bool in_all = true;  // one of "*"; false for what other columns hold in a better form
};

/// Builds a scan row by row. Columns viewpoint_x, viewpoint_y, viewpoint_z, if the file has all
/// three, become viewpoints. (A template, so that unused readers cost no compile time.)
/// @tparam Text  a text_cursor
template <class Text>
class scan_builder {
  public:
    /// @param columns  of the file: a range of file_column
    /// @param wanted   the names of the columns that become fields; "*" stands for all others that
    ///                 are neither coordinates nor viewpoints: of equal names the first
    /// @param text     position of the column names, for the error message
    /// @throws gnomon::error  if x, y, z or a requested column is missing
    scan_builder(const auto& columns, const std::vector<std::string>& wanted, const Text& text)
        : axes_{column(columns, "x", text), column(columns, "y", text),
                column(columns, "z", text)} {
        for (const char* const name : {"viewpoint_x", "viewpoint_y", "viewpoint_z"}) {
            const std::size_t k = find(columns, name);
            if (k == columns.size()) break;
            viewpoint_.push_back(k);
        }
        for (const std::string& name : wanted) {
            if (name == "*")
                add_all(columns);
            else
                add_field(columns, column(columns, name, text));
        }
    }

    /// Allocates memory for `points` points. Precondition: the caller has checked that the file is
    /// large enough to hold them.
    void reserve(std::size_t points) {
        result_.points.reserve(points);
        for (scan::scalar_field& field : result_.fields) field.values.reserve(points);
    }

    /// Adds a point.
    /// @param row  one value per column
    void add(const std::vector<double>& row) {
        result_.points.emplace_back(row[axes_[0]], row[axes_[1]], row[axes_[2]]);
        for (std::size_t k = 0; k < sources_.size(); ++k)
            result_.fields[k].values.push_back(row[sources_[k]]);
        if (viewpoint_.size() == 3)
            viewpoints_.emplace_back(row[viewpoint_[0]], row[viewpoint_[1]], row[viewpoint_[2]]);
    }

    /// Returns the scan. Its viewpoints are those of the rows, or else `viewpoints`.
    [[nodiscard]] scan finish(viewpoint_table viewpoints = {}) && {
        result_.viewpoints = viewpoint_.size() == 3 ? viewpoint_table(std::move(viewpoints_))
                                                    : std::move(viewpoints);
        return std::move(result_);
    }

  private:
    /// The index of the first column `name`; their number if there is none.
    [[nodiscard]] static std::size_t find(const auto& columns, std::string_view name) {
        std::size_t k = 0;
        while (k < columns.size() && columns[k].name != name) ++k;
        return k;
    }

    /// The index of the column `name`.
    /// @throws gnomon::error  with the list of all columns, if it is missing
    [[nodiscard]] static std::size_t column(const auto& columns, const std::string& name,
                                            const Text& text) {
        const std::size_t k = find(columns, name);
        if (k < columns.size() && name != "_") return k;

        std::string there;
        for (const auto& each : columns)
            if (each.name != "_") there += (there.empty() ? "" : ", ") + each.name;
        text.fail("there is no field " + in_quotes(name) + "; there are: " + there);
    }

    void add_field(const auto& columns, std::size_t k) {
        sources_.push_back(k);
        result_.fields.push_back({columns[k].name, {}, columns[k].type});
    }

    void add_all(const auto& columns) {
        const auto is_in = [](std::size_t k, const auto& some) {
            return std::find(some.begin(), some.end(), k) != some.end();
        };
        for (std::size_t k = 0; k < columns.size(); ++k) {
            const std::string& name = columns[k].name;
            if (name == "_" || !columns[k].in_all || find(columns, name) < k) continue;
            if (is_in(k, axes_) || is_in(k, sources_)) continue;
            if (viewpoint_.size() == axes_.size() && is_in(k, viewpoint_)) continue;
            add_field(columns, k);
        }
    }

    std::array<std::size_t, 3> axes_;     // columns of x, y and z
    std::vector<std::size_t> sources_;    // columns of the fields
    std::vector<std::size_t> viewpoint_;  // columns of the viewpoint; used if all three exist
    std::vector<Eigen::Vector3d> viewpoints_;
    scan result_;
};

}  // namespace gnomon::io::detail
