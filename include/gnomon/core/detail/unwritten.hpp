// SPDX-License-Identifier: BSL-1.0
/// @file
/// Vectors whose resize() leaves new numbers unwritten. To write a large result twice, zeros first,
/// takes longer than to compute a part of it, and happens on one thread.
#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>

namespace gnomon::detail {

/// The allocator of such a vector.
template <class T>
struct unwritten {
    static_assert(std::is_trivially_default_constructible_v<T>);
    using value_type = T;

    unwritten() = default;
    template <class U>
    explicit(false) unwritten(const unwritten<U>&) {}

    [[nodiscard]] T* allocate(std::size_t n) { return std::allocator<T>().allocate(n); }
    void deallocate(T* first, std::size_t n) noexcept { std::allocator<T>().deallocate(first, n); }
    /// Without a value; with one, `std::allocator_traits` constructs as usual.
    void construct(T* at) { ::new (static_cast<void*>(at)) T; }

    friend bool operator==(const unwritten&, const unwritten&) { return true; }
};

}  // namespace gnomon::detail
