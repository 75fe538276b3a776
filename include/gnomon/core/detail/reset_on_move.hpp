// SPDX-License-Identifier: BSL-1.0
/// @file
/// Numbers that describe a container, such as its size: they go with its memory when it is moved.
#pragma once

#include <utility>

namespace gnomon::detail {

/// A value of a trivial type that is T{} after it was moved from.
template <class T>
class reset_on_move {
  public:
    reset_on_move() = default;
    explicit(false) reset_on_move(T value) : value_(value) {}
    reset_on_move(const reset_on_move&) = default;
    reset_on_move(reset_on_move&& other) noexcept : value_(std::exchange(other.value_, T{})) {}
    reset_on_move& operator=(const reset_on_move&) = default;
    reset_on_move& operator=(reset_on_move&& other) noexcept {
        value_ = other.value_;
        other.value_ = T{};  // also of itself, as a vector
        return *this;
    }

    explicit(false) operator T() const { return value_; }

  private:
    T value_{};
};

}  // namespace gnomon::detail
