// SPDX-License-Identifier: BSL-1.0
/// @file
/// How a number lies in a binary file, and how to take it out and put it in.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace gnomon::io::detail {

/// Kind ('I' signed, 'U' unsigned, 'F' floating-point, as PCD says) and size in bytes: the
/// combinations of `visit_type`.
struct scalar_layout {
    char kind;
    std::size_t size;

    friend bool operator==(scalar_layout, scalar_layout) = default;
};

/// Calls `f` with a zero of the C++ type that `layout` describes.
/// @return whether there is such a type
template <class F>
constexpr bool visit_type(scalar_layout layout, F f) {
    if (layout.size > 8) return false;
    switch (layout.kind * 16 + static_cast<int>(layout.size)) {
        case 'I' * 16 + 1:
            f(std::int8_t{});
            return true;
        case 'I' * 16 + 2:
            f(std::int16_t{});
            return true;
        case 'I' * 16 + 4:
            f(std::int32_t{});
            return true;
        case 'I' * 16 + 8:
            f(std::int64_t{});
            return true;
        case 'U' * 16 + 1:
            f(std::uint8_t{});
            return true;
        case 'U' * 16 + 2:
            f(std::uint16_t{});
            return true;
        case 'U' * 16 + 4:
            f(std::uint32_t{});
            return true;
        case 'U' * 16 + 8:
            f(std::uint64_t{});
            return true;
        case 'F' * 16 + 4:
            f(float{});
            return true;
        case 'F' * 16 + 8:
            f(double{});
            return true;
        default:
            return false;
    }
}

/// The number at `bytes`; 64-bit integers beyond 2^53 are rounded.
/// Precondition: layout.size bytes can be read, and the layout has a type.
[[nodiscard]] inline double decode(const char* bytes, scalar_layout layout, std::endian order) {
    double result = 0;
    visit_type(layout, [&](auto zero) {
        std::array<char, sizeof zero> copy;
        std::copy_n(bytes, copy.size(), copy.begin());
        if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
        result = static_cast<double>(std::bit_cast<decltype(zero)>(copy));
    });
    return result;
}

/// Appends `value` to `bytes`.
template <class T>
void encode(std::string& bytes, T value, std::endian order) {
    auto copy = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
    bytes.append(copy.data(), copy.size());
}

}  // namespace gnomon::io::detail
