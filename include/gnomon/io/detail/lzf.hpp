// SPDX-License-Identifier: BSL-1.0
/// @file
/// Decompression of LZF (Marc Lehmann, LibLZF), the format of points in binary_compressed PCD
/// files.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon::io::detail {

/// The upper bound of the compression ratio: three bytes encode at most 264.
inline constexpr std::size_t lzf_best_ratio = 88;

/// Decompresses `packed`. O(size).
/// @return `size` bytes; none if the data are damaged or decompress to another size
template <class = void>  // a template, so that unused readers cost no compile time
[[nodiscard]] std::optional<std::string> unpack_lzf(std::string_view packed, std::size_t size) {
    if (size / lzf_best_ratio > packed.size()) return std::nullopt;
    std::string result;
    result.reserve(size);
    std::size_t i = 0;
    while (i < packed.size()) {
        const std::size_t control = static_cast<unsigned char>(packed[i++]);
        if (control < 32) {  // literal run
            const std::size_t length = control + 1;
            if (length > packed.size() - i || length > size - result.size()) return std::nullopt;
            result.append(packed.substr(i, length));
            i += length;
        } else {  // back reference
            std::size_t length = control / 32 + 2;
            const bool is_long = length == 9;
            if (packed.size() - i < (is_long ? 2U : 1U)) return std::nullopt;
            if (is_long) length += static_cast<unsigned char>(packed[i++]);
            const std::size_t distance =
                control % 32 * 256 + static_cast<unsigned char>(packed[i++]) + 1;
            if (distance > result.size() || length > size - result.size()) return std::nullopt;
            // Byte by byte, since source and destination can overlap.
            for (std::size_t k = 0; k < length; ++k)
                result.push_back(result[result.size() - distance]);
        }
    }
    if (result.size() != size) return std::nullopt;
    return result;
}

}  // namespace gnomon::io::detail
