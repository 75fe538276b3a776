// SPDX-License-Identifier: BSL-1.0
/// @file
/// Binary representation of numbers in files: types, decoding and encoding.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>

namespace gnomon::io::detail {

/// A binary number type: kind and size. `visit_type` lists the valid combinations.
struct scalar_layout {
    char kind;         ///< as in PCD: 'I' signed, 'U' unsigned, 'F' floating-point
    std::size_t size;  ///< [bytes]

    friend bool operator==(scalar_layout, scalar_layout) = default;
};

/// Calls `f` with a zero of the C++ type of `layout`.
/// @return false, without a call, if there is no such type
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

/// Returns the number at `bytes` as a double; 64-bit integers above 2^53 are rounded.
/// Precondition: layout.size bytes can be read, and `layout` is valid.
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

/// Appends the bytes of `value` in the given byte order.
template <class T>
void encode(std::string& bytes, T value, std::endian order) {
    auto copy = std::bit_cast<std::array<char, sizeof(T)>>(value);
    if (order != std::endian::native) std::reverse(copy.begin(), copy.end());
    bytes.append(copy.data(), copy.size());
}

}  // namespace gnomon::io::detail
