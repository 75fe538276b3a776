// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/detail/touched_vector.hpp>

#if defined(__SANITIZE_ADDRESS__)
#include <sanitizer/asan_interface.h>
#endif

namespace {

struct thirteen {
    int value = 13;
    double more[12] = {};
};

TEST(touched_vector, holds_n_default_values) {
    const auto expect = [](std::size_t n, const auto& run) {
        std::vector<thirteen> values;
        gnomon::detail::resize_touched(values, n, run);
        ASSERT_EQ(values.size(), n);
        for (const thirteen& v : values) ASSERT_TRUE(v.value == 13 && v.more[11] == 0.0);
    };
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{100'000}}) {
        expect(n, gnomon::sequential{});
        expect(n, gnomon::threads{3});
    }
}

TEST(touched_vector, touched_array_can_be_written) {
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{1'000'000}}) {
        const auto values = gnomon::detail::touched_array<double>(n, gnomon::threads{3});
        std::fill_n(values.get(), n, 13.0);
        ASSERT_EQ(std::count(values.get(), values.get() + n, 13.0), static_cast<std::ptrdiff_t>(n));
    }
}

/// Annotates the unused capacity of a vector for AddressSanitizer, as some standard libraries do.
TEST(touched_vector, touches_unused_capacity) {
    std::vector<std::byte> memory(10'000, std::byte{1});
#if defined(__SANITIZE_ADDRESS__)
    __asan_poison_memory_region(memory.data(), memory.size());
#endif
    gnomon::detail::touch(memory.data(), memory.data() + memory.size());
#if defined(__SANITIZE_ADDRESS__)
    __asan_unpoison_memory_region(memory.data(), memory.size());
#endif
    EXPECT_EQ(std::count(memory.begin(), memory.end(), std::byte{}), 3);
}

}  // namespace
