// SPDX-License-Identifier: BSL-1.0
/// @file
/// The encodings and scalar types of PLY files (G. Turk, The PLY Polygon File Format, 1994).
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include <gnomon/core/scan.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>

namespace gnomon::io {

/// The encoding of a PLY file.
enum class ply_format { binary_little_endian, binary_big_endian, ascii };

/// The type of a property in a file. There are no 64-bit integers: those of PCD files and of values
/// in memory become float64, exact up to 2^53.
using field_type = scan::field_type;

namespace detail {

/// The names of the encodings in the header, in the order of `ply_format`.
inline constexpr std::array<std::string_view, 3> ply_format_names = {"binary_little_endian",
                                                                     "binary_big_endian", "ascii"};

/// A scalar type of PLY.
struct ply_type {
    std::string_view name;        ///< of 1994; written, since every reader accepts it
    std::string_view later_name;  ///< accepted as well
    scalar_layout layout;         ///< binary representation
};

/// The scalar types, in the order of `field_type`.
inline constexpr std::array<ply_type, 8> ply_types = {{{"char", "int8", {'I', 1}},
                                                       {"uchar", "uint8", {'U', 1}},
                                                       {"short", "int16", {'I', 2}},
                                                       {"ushort", "uint16", {'U', 2}},
                                                       {"int", "int32", {'I', 4}},
                                                       {"uint", "uint32", {'U', 4}},
                                                       {"float", "float32", {'F', 4}},
                                                       {"double", "float64", {'F', 8}}}};

/// Returns the names and the binary representation of `type`.
[[nodiscard]] constexpr const ply_type& ply_type_of(field_type type) {
    return ply_types[static_cast<std::size_t>(type)];
}

/// Returns the type of a number in a file; float64 for integers of 64 bits, which PLY does not
/// have.
[[nodiscard]] constexpr field_type field_type_of(scalar_layout layout) {
    for (std::size_t k = 0; k < ply_types.size(); ++k)
        if (ply_types[k].layout == layout) return static_cast<field_type>(k);
    return field_type::float64;
}

}  // namespace detail
}  // namespace gnomon::io
