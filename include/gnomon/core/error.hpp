// SPDX-License-Identifier: BSL-1.0
/// @file
/// Error reporting. Bad data gives results whose `trust` is not usable; a broken file throws
/// `gnomon::error`; an invalid argument (k = 0, a negative radius) throws `std::invalid_argument`.
/// The library prints nothing, except where exceptions are turned off (-fno-exceptions): there,
/// what would be thrown prints its message on stderr and aborts the program.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <gnomon/core/detail/exceptions.hpp>

namespace gnomon {

/// A file that cannot be read or written, or whose contents are damaged. The message names the file
/// and the position in it.
class error : public std::runtime_error {
  public:
    /// @param file      the file's name as the caller gave it
    /// @param position  where in the file: "line 12", "byte 381", or "" for the file as a whole
    /// @param message   what is wrong
    error(std::string file, std::string position, const std::string& message)
        : std::runtime_error(file + (position.empty() ? "" : ", " + position) + ": " + message),
          file_(std::move(file)),
          position_(std::move(position)) {}

    /// The file's name as the caller gave it.
    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    /// The position in the file: "line 12", "byte 381", or "" for the file as a whole.
    [[nodiscard]] const std::string& position() const noexcept { return position_; }

  private:
    std::string file_;
    std::string position_;
};

namespace detail {

/// Checks an argument of a public function. O(1).
/// @throws std::invalid_argument  with `message` unless `condition` holds
constexpr void require(bool condition, const char* message) {
    if (!condition) GNOMON_THROW(std::invalid_argument(message));
}

}  // namespace detail
}  // namespace gnomon
