// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a PLY file is made of: numbers of eight types, encoded in one of three ways (Turk 1994, The
/// PLY Polygon File Format).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <gnomon/io/detail/scalar_layout.hpp>

namespace gnomon::io {

/// The encodings; `ply_format_names` says what they are called.
enum class ply_format { binary_little_endian, binary_big_endian, ascii };

/// The types of a property; `ply_types` says what they are called.
enum class field_type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

namespace detail {

inline constexpr std::array<std::string_view, 3> ply_format_names = {"binary_little_endian",
                                                                     "binary_big_endian", "ascii"};

/// A scalar type under the name of 1994, which every reader knows, and the later one.
struct ply_type {
    std::string_view name;
    std::string_view later_name;
    scalar_layout layout;
};

/// In the order of `field_type`.
inline constexpr std::array<ply_type, 8> ply_types = {{{"char", "int8", {'I', 1}},
                                                       {"uchar", "uint8", {'U', 1}},
                                                       {"short", "int16", {'I', 2}},
                                                       {"ushort", "uint16", {'U', 2}},
                                                       {"int", "int32", {'I', 4}},
                                                       {"uint", "uint32", {'U', 4}},
                                                       {"float", "float32", {'F', 4}},
                                                       {"double", "float64", {'F', 8}}}};

/// What the PLY header calls `type`, and how it lies in the file.
[[nodiscard]] constexpr const ply_type& ply_type_of(field_type type) {
    return ply_types[static_cast<std::size_t>(type)];
}

}  // namespace detail
}  // namespace gnomon::io
