// SPDX-License-Identifier: BSL-1.0
/// @file
/// Assembles a scan from rows of numbers: selects the columns of the coordinates, of the viewpoint
/// and of the requested fields.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/io/detail/text_cursor.hpp>

namespace gnomon::io::detail {

/// Builds a scan row by row. Columns viewpoint_x, viewpoint_y, viewpoint_z, if the file has all
/// three, become viewpoints. (A template, so that unused readers cost no compile time.)
/// @tparam Text  a text_cursor
template <class Text>
class scan_builder {
  public:
    /// @param columns  the names of the columns in the file; "_" is padding
    /// @param wanted   the names of the columns that become fields
    /// @param text     position of the column names, for the error message
    /// @throws gnomon::error  if x, y, z or a requested column is missing
    scan_builder(const std::vector<std::string>& columns, const std::vector<std::string>& wanted,
                 const Text& text)
        : axes_{column(columns, "x", text), column(columns, "y", text),
                column(columns, "z", text)} {
        for (const std::string& name : wanted) {
            sources_.push_back(column(columns, name, text));
            result_.fields.push_back({name, {}});
        }
        for (const char* const name : {"viewpoint_x", "viewpoint_y", "viewpoint_z"}) {
            const auto found = std::find(columns.begin(), columns.end(), name);
            if (found == columns.end()) break;
            viewpoint_.push_back(static_cast<std::size_t>(found - columns.begin()));
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
    /// The index of the column `name`.
    /// @throws gnomon::error  with the list of all columns, if it is missing
    [[nodiscard]] static std::size_t column(const std::vector<std::string>& columns,
                                            const std::string& name, const Text& text) {
        const auto found = std::find(columns.begin(), columns.end(), name);
        if (found != columns.end() && name != "_")
            return static_cast<std::size_t>(found - columns.begin());

        std::string there;
        for (const std::string& each : columns)
            if (each != "_") there += (there.empty() ? "" : ", ") + each;
        text.fail("there is no field " + in_quotes(name) + "; there are: " + there);
    }

    std::array<std::size_t, 3> axes_;     // columns of x, y and z
    std::vector<std::size_t> sources_;    // columns of the fields
    std::vector<std::size_t> viewpoint_;  // columns of the viewpoint; used if all three exist
    std::vector<Eigen::Vector3d> viewpoints_;
    scan result_;
};

}  // namespace gnomon::io::detail
