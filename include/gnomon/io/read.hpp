// SPDX-License-Identifier: BSL-1.0
/// @file
/// Reads a scan from a PLY, PCD, legacy VTK or XYZ file, and in programs that include
/// <gnomon/io/read_las.hpp> from a LAS file. The format is detected from the contents, not from the
/// file name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <gnomon/core/detail/exceptions.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/las_reader.hpp>
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

/// Returns whether one of the first lines begins with a keyword of PCD, before any line that begins
/// with a number.
[[nodiscard]] inline bool looks_like_pcd(const input& file) {
    constexpr int max_lines = 32;  // comments can precede the header
    text_cursor text(file);
    for (int i = 0; i < max_lines; ++i) {
        const auto line = text.line();
        if (!line) return false;
        const std::string_view word = splitter(*line).next().value_or("");
        if (line->starts_with("# .PCD") || is_pcd_keyword(word)) return true;
        if (is_number(word)) return false;
    }
    return false;
}

/// Returns whether this is a mesh: in OFF, STL, glTF or COLLADA, or in OBJ, of which the first line
/// that is no comment begins with a keyword.
[[nodiscard]] inline bool looks_like_mesh(const input& file) {
    for (const std::string_view magic : {"OFF", "solid ", "glTF", "<?xml", "<COLLADA"})
        if (std::string_view(file.bytes).starts_with(magic)) return true;
    text_cursor text(file);
    while (const auto line = text.line()) {
        const std::string_view word = splitter(*line).next().value_or("");
        if (word.empty() || word.starts_with("#")) continue;
        return word == "v" || word == "o" || word == "g" || word == "mtllib";
    }
    return false;
}

/// Refuses the formats that are not read here, with the name of a header or tool that does or that
/// converts them.
template <class = void>
void refuse_unread(const input& file) {
    const std::string_view bytes = file.bytes;
    if (bytes.starts_with("LASF"))
        GNOMON_THROW(
            error(file.name, "byte 0", "a LAS file: include <gnomon/io/read_las.hpp> to read it"));
    if (bytes.starts_with("ASTM-E57"))
        GNOMON_THROW(
            error(file.name, "byte 0",
                  "an E57 file, which is not read: convert it, e.g. by \"pdal translate a.e57 "
                  "a.las\" or CloudCompare"));
    if (looks_like_mesh(file))
        GNOMON_THROW(error(file.name, "byte 0",
                           "a mesh, which is no scan: simulate one of it, e.g. by "
                           "\"simulate_scan --scene a.obj --out DIR\""));
}

}  // namespace detail

/// Parses a PLY, PCD, legacy VTK or XYZ file; see `read_ply`, `read_pcd`, `read_vtk`, `read_xyz`.
/// LAS files are parsed by `read_las`, if a file of the program includes <gnomon/io/read_las.hpp>.
/// @param file    name and contents of the file
/// @param fields  names of further columns that become fields of the scan, in this order; "*"
///                stands for all. `field_properties` writes them
/// @return the points [m], in the order of the file, with viewpoints and fields
/// @throws gnomon::error  if the file is damaged or a field is missing (the message lists the
///                        fields of the file), and for LAZ and E57 files and meshes (the message
///                        names a tool that converts them)
/// Complexity: O(bytes).
template <class = void>  // a template, so that unused readers cost no compile time
[[nodiscard]] scan read(const input& file, const std::vector<std::string>& fields = {}) {
    const std::string_view first_line = detail::text_cursor(file).line().value_or("");
    if (detail::splitter(first_line).next() == "ply") return read_ply(file, fields);
    if (first_line.starts_with(detail::vtk_magic)) return read_vtk(file, fields);
    if (first_line.starts_with("LASF") && detail::las_reader != nullptr)
        return detail::las_reader(file, fields);
    detail::refuse_unread(file);
    if (detail::looks_like_pcd(file)) return read_pcd(file, fields);
    return read_xyz(file, fields);
}

/// Reads the file `path`; parameters and result as above.
/// @throws gnomon::error  as above, and with the operating system's message on a failure to read
/// Complexity: O(bytes).
template <class = void>  // a template, so that unused readers cost no compile time
[[nodiscard]] scan read(const std::string& path, const std::vector<std::string>& fields = {}) {
    return read(load(path), fields);
}

}  // namespace gnomon::io
