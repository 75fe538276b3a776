// SPDX-License-Identifier: BSL-1.0
/// @file
/// How gnomon fails. Bad *data* is answered with a `trust` beside the number, a broken file with
/// `gnomon::error`, an impossible argument (k = 0, a negative radius) with `std::invalid_argument`.
/// Nothing is ever printed.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace gnomon {

/// The outside world failed us: a file that is missing, truncated or not what it claims to be.
class error : public std::runtime_error {
  public:
    /// @param file      the file's name as the caller gave it
    /// @param position  where in the file: "line 12", "byte 381", or "" for the file as a whole
    /// @param message   what is wrong
    error(std::string file, std::string position, const std::string& message)
        : std::runtime_error(file + (position.empty() ? "" : ", " + position) + ": " + message),
          file_(std::move(file)),
          position_(std::move(position)) {}

    [[nodiscard]] const std::string& file() const noexcept { return file_; }
    [[nodiscard]] const std::string& position() const noexcept { return position_; }

  private:
    std::string file_;
    std::string position_;
};

namespace detail {

/// Checks an argument at a public door, in constant time.
/// @throws std::invalid_argument  with `message` unless `condition` holds
constexpr void require(bool condition, const char* message) {
    if (!condition) throw std::invalid_argument(message);
}

}  // namespace detail
}  // namespace gnomon
