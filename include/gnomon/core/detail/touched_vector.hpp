// SPDX-License-Identifier: BSL-1.0
/// @file
/// Large arrays whose memory pages are first written by all threads. The operating system maps a
/// page at its first write, which for large results takes longer than computing them; here each
/// thread maps its share.
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

#include <gnomon/core/detail/attributes.hpp>
#include <gnomon/core/execution.hpp>

namespace gnomon::detail {

/// Writes one byte to each page from `begin` to `end`. The memory can be the unused capacity of a
/// vector; some standard libraries would have AddressSanitizer report the write, so it is off here.
[[GNOMON_NO_SANITIZE_ADDRESS]] inline void touch(volatile std::byte* begin,
                                                 const volatile std::byte* end) {
    constexpr std::ptrdiff_t page = 4096;  // [bytes], of x86-64; performance only
    for (; begin < end; begin += std::min(page, end - begin)) *begin = std::byte{};
}

/// Writes to each page of the memory of n values, in parallel. Overwrites them. O(n).
template <class T, execution X>
void touch_all(T* values, std::size_t n, const X& run) {
    constexpr std::size_t chunk = 1 << 20;  // [bytes]; performance only
    auto* const bytes = reinterpret_cast<volatile std::byte*>(values);
    const std::size_t size = n * sizeof(T);
    run((size + chunk - 1) / chunk,
        [&](std::size_t c) { touch(bytes + c * chunk, bytes + std::min(size, (c + 1) * chunk)); });
}

/// Gives a vector n values, anything of which may be left over from its last use; allocates only to
/// grow.
template <class T, class Allocator, execution X>
void resize_touched(std::vector<T, Allocator>& values, std::size_t n, const X& run) {
    if (values.capacity() < n) {
        std::vector<T, Allocator>().swap(values);  // first: old and new memory do not add up
        values.reserve(n);
        touch_all(values.data(), n, run);
    }
    values.resize(n);
}

/// An array of n uninitialized values, its pages mapped by all threads. O(n).
template <class T, execution X>
[[nodiscard]] std::unique_ptr<T[]> touched_array(std::size_t n, const X& run) {
    static_assert(std::is_trivially_default_constructible_v<T>);
    auto values = std::make_unique_for_overwrite<T[]>(n);
    touch_all(values.get(), n, run);
    return values;
}

}  // namespace gnomon::detail
