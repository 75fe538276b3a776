// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads a scan from a file of any format that we know; what the file begins with decides, and not
/// its name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/number.hpp>
#include <gnomon/io/detail/pcd_header.hpp>
#include <gnomon/io/detail/splitter.hpp>
#include <gnomon/io/detail/text_cursor.hpp>
#include <gnomon/io/input.hpp>
#include <gnomon/io/read_pcd.hpp>
#include <gnomon/io/read_ply.hpp>
#include <gnomon/io/read_vtk.hpp>
#include <gnomon/io/read_xyz.hpp>

namespace gnomon::io {
namespace detail {

/// Whether a line near the beginning, before any number, begins with a keyword of PCD.
[[nodiscard]] inline bool looks_like_pcd(const input& file) {
    text_cursor text(file);
    for (int i = 0; i < 32; ++i) {
        const auto line = text.line();
        if (!line) return false;
        const std::string_view word = splitter(*line).next().value_or("");
        if (line->starts_with("# .PCD") || is_pcd_keyword(word)) return true;
        if (is_number(word)) return false;
    }
    return false;
}

}  // namespace detail

/// Parses a PLY, PCD, legacy VTK or XYZ file; see `read_ply`, `read_pcd`, `read_vtk`, `read_xyz`.
/// @param fields  names of further columns that become fields of the scan, in this order
/// @throws gnomon::error  if the file is damaged or has not all the fields; it lists
///                        those there are
/// Complexity: O(bytes).
template <class = void>  // costs the compiler nothing where nobody reads
[[nodiscard]] scan read(const input& file, const std::vector<std::string>& fields = {}) {
    const std::string_view first_line = detail::text_cursor(file).line().value_or("");
    if (detail::splitter(first_line).next() == "ply") return read_ply(file, fields);
    if (first_line.starts_with(detail::vtk_magic)) return read_vtk(file, fields);
    if (detail::looks_like_pcd(file)) return read_pcd(file, fields);
    return read_xyz(file, fields);
}

/// Reads the file `path`.
/// @throws gnomon::error  moreover with the system's reason, if it cannot be read
template <class = void>  // costs the compiler nothing where nobody reads
[[nodiscard]] scan read(const std::string& path, const std::vector<std::string>& fields = {}) {
    return read(load(path), fields);
}

}  // namespace gnomon::io
