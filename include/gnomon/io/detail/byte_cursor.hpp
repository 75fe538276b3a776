// SPDX-License-Identifier: BSL-1.0
/// @file
/// A cursor in binary data. Access is bounds-checked, and errors name the byte.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include <gnomon/core/error.hpp>
#include <gnomon/io/detail/scalar_layout.hpp>
#include <gnomon/io/input.hpp>

namespace gnomon::io::detail {

/// Reads an input as bytes. Refers to the input.
class byte_cursor {
  public:
    /// @param offset  position of the first byte
    byte_cursor(const input& file, std::size_t offset) : file_(&file), offset_(offset) {}

    /// Returns the next `count` bytes and advances.
    /// @throws gnomon::error  if fewer bytes are left
    [[nodiscard]] std::string_view take(std::size_t count) {
        if (count > remaining()) fail("the file ends too early");
        const std::string_view result = std::string_view(file_->bytes).substr(offset_, count);
        offset_ += count;
        return result;
    }

    /// Returns the next number and advances.
    /// @throws gnomon::error  if too few bytes are left
    [[nodiscard]] double number(scalar_layout layout, std::endian order) {
        return decode(take(layout.size).data(), layout, order);
    }

    /// Checks that the rest of the file can hold `rows` rows, before memory is allocated for them.
    /// @param size  minimum number of bytes per row
    /// @throws gnomon::error  if it cannot
    void require_rows(std::uint64_t rows, std::size_t size) const {
        if (rows > remaining() / std::max<std::size_t>(size, 1))
            fail(std::to_string(rows) + " points or elements are declared, but only " +
                 std::to_string(remaining()) + " bytes are left");
    }

    /// The number of bytes to the end of the file.
    [[nodiscard]] std::size_t remaining() const { return file_->bytes.size() - offset_; }

    /// Throws an error at the current byte.
    [[noreturn]] void fail(const std::string& message) const {
        GNOMON_THROW(error(file_->name, "byte " + std::to_string(offset_), message));
    }

  private:
    const input* file_;
    std::size_t offset_;
};

}  // namespace gnomon::io::detail
