// SPDX-License-Identifier: BSL-1.0
/// @file
/// A place in binary data: hands out bytes that are really there, and says at which byte something
/// was wrong.
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

/// Reads an input as bytes, from `offset` on; refers to it.
class byte_cursor {
  public:
    byte_cursor(const input& file, std::size_t offset) : file_(&file), offset_(offset) {}

    /// The next `count` bytes.
    /// @throws gnomon::error  if fewer are left
    [[nodiscard]] std::string_view take(std::size_t count) {
        if (count > remaining()) fail("the file ends too early");
        const std::string_view result = std::string_view(file_->bytes).substr(offset_, count);
        offset_ += count;
        return result;
    }

    /// The next number.
    /// @throws gnomon::error  if too few bytes are left
    [[nodiscard]] double number(scalar_layout layout, std::endian order) {
        return decode(take(layout.size).data(), layout, order);
    }

    /// Refuses a count of rows that the rest of the file cannot hold, before memory is asked for.
    /// @param size  at least so many bytes per row
    /// @throws gnomon::error  if the rows would not fit
    void require_rows(std::uint64_t rows, std::size_t size) const {
        if (rows > remaining() / std::max<std::size_t>(size, 1))
            fail(std::to_string(rows) + " points or elements are declared, but only " +
                 std::to_string(remaining()) + " bytes are left");
    }

    /// Bytes to the end of the file.
    [[nodiscard]] std::size_t remaining() const { return file_->bytes.size() - offset_; }

    /// Complains about what comes next.
    [[noreturn]] void fail(const std::string& message) const {
        throw error(file_->name, "byte " + std::to_string(offset_), message);
    }

  private:
    const input* file_;
    std::size_t offset_;
};

}  // namespace gnomon::io::detail
