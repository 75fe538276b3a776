// SPDX-License-Identifier: BSL-1.0
/// @file
/// Large results, whose memory all threads fetch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <gnomon/core/execution.hpp>

namespace gnomon::detail {

/// Writes to each page from `begin` to `end`. The memory may be a vector's that has not begun to
/// use it, which some standard libraries report to AddressSanitizer: here it is meant.
[[gnu::no_sanitize_address]] inline void touch(volatile std::byte* begin,
                                               const volatile std::byte* end) {
    constexpr std::ptrdiff_t page = 4096;  // [bytes]
    for (; begin < end; begin += std::min(page, end - begin)) *begin = std::byte{};
}

/// Touches the memory of n values. The system hands out memory when it is first written to, page
/// after page, which for large results takes longer than the writing: here each thread asks for its
/// part.
template <class T, execution X>
void touch_all(T* values, std::size_t n, const X& run) {
    constexpr std::size_t chunk = 1 << 20;  // [bytes]
    auto* const bytes = reinterpret_cast<volatile std::byte*>(values);
    const std::size_t size = n * sizeof(T);
    run((size + chunk - 1) / chunk,
        [&](std::size_t c) { touch(bytes + c * chunk, bytes + std::min(size, (c + 1) * chunk)); });
}

/// A vector of n values T{}.
template <class T, execution X>
[[nodiscard]] std::vector<T> touched_vector(std::size_t n, const X& run) {
    std::vector<T> values;
    values.reserve(n);
    touch_all(values.data(), n, run);
    values.resize(n);
    return values;
}

/// An array of n numbers, or the like, with anything in it.
template <class T, execution X>
[[nodiscard]] std::unique_ptr<T[]> touched_array(std::size_t n, const X& run) {
    static_assert(std::is_trivially_default_constructible_v<T>);
    auto values = std::make_unique_for_overwrite<T[]>(n);
    touch_all(values.get(), n, run);
    return values;
}

}  // namespace gnomon::detail
