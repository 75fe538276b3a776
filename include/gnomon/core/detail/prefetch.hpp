// SPDX-License-Identifier: BSL-1.0
/// @file
/// Loads of memory before it is needed, while the processor computes something else. For
/// performance only; nothing for compilers other than g++ and clang.
#pragma once

#include <memory>
#include <type_traits>

namespace gnomon::detail {

/// Starts to load the cache line at an address, which need not be one of an object.
inline void prefetch([[maybe_unused]] const void* at) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(at);
#endif
}

/// The same for memory that will be written.
inline void prefetch_to_write([[maybe_unused]] const void* at) {
#if defined(__GNUC__) || defined(__clang__)
    __builtin_prefetch(at, 1);
#endif
}

/// Starts to load element i of a range whose elements are in memory.
inline void prefetch_element([[maybe_unused]] const auto& range, [[maybe_unused]] auto i) {
    if constexpr (std::is_lvalue_reference_v<decltype(range[i])>) {
        const auto* const element = std::addressof(range[i]);
        prefetch(element);
        prefetch(reinterpret_cast<const char*>(element + 1) - 1);
    }
}

}  // namespace gnomon::detail
