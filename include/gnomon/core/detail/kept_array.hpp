// SPDX-License-Identifier: BSL-1.0
/// @file
/// An array of numbers that is refilled for each scan and allocates memory only to grow.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>

#include <gnomon/core/detail/reset_on_move.hpp>
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/execution.hpp>

namespace gnomon::detail {

/// n trivial values. The content is unspecified after resize(); copies copy the content.
template <class T>
class kept_array {
  public:
    kept_array() = default;
    kept_array(const kept_array& other) { *this = other; }
    kept_array(kept_array&&) = default;
    kept_array& operator=(const kept_array& other) {
        if (this == &other) return *this;
        resize(other.size_, sequential{});
        std::copy_n(other.values_.get(), size_, values_.get());
        return *this;
    }
    kept_array& operator=(kept_array&&) = default;
    ~kept_array() = default;

    /// Makes it an array of n values. Allocates if n is larger than ever before.
    template <execution X>
    void resize(std::size_t n, const X& run) {
        if (n > capacity_) {
            values_.reset();  // first, so that old and new memory do not add up
            size_ = capacity_ = 0;
            values_ = touched_array<T>(n, run);
            capacity_ = n;
        }
        size_ = n;
    }

    [[nodiscard]] std::size_t size() const { return size_; }
    [[nodiscard]] T* data() { return values_.get(); }
    [[nodiscard]] const T* data() const { return values_.get(); }
    [[nodiscard]] T& operator[](std::size_t i) { return values_[i]; }
    [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }

  private:
    std::unique_ptr<T[]> values_;
    reset_on_move<std::size_t> size_;
    reset_on_move<std::size_t> capacity_;
};

}  // namespace gnomon::detail
