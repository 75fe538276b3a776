// SPDX-License-Identifier: BSL-1.0
/// @file
/// Large results, whose memory all threads fetch.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gnomon/core/execution.hpp>

namespace gnomon::detail {

/// A vector of n values T{}. The system hands out memory when it is first written to, page after
/// page, which for large results takes longer than the writing: here each thread asks for its part.
template <class T, execution X>
[[nodiscard]] std::vector<T> touched_vector(std::size_t n, const X& run) {
    constexpr std::size_t page = 4096, chunk = 256 * page;  // [bytes]
    std::vector<T> values;
    values.reserve(n);
    auto* const bytes = reinterpret_cast<volatile std::byte*>(values.data());
    const std::size_t size = n * sizeof(T);
    run((size + chunk - 1) / chunk, [&](std::size_t c) {
        for (std::size_t b = c * chunk; b < std::min(size, (c + 1) * chunk); b += page)
            bytes[b] = std::byte{};
    });
    values.resize(n);
    return values;
}

}  // namespace gnomon::detail
