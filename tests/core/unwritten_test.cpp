// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstring>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/detail/unwritten.hpp>

namespace {

using numbers = std::vector<float, gnomon::detail::unwritten<float>>;

TEST(unwritten, leaves_the_memory_of_a_number_as_it_is) {
    constexpr std::size_t n = 1000;
    gnomon::detail::unwritten<float> allocator;
    float* const memory = allocator.allocate(n);
    std::memset(memory, 13, n * sizeof(float));
    for (std::size_t i = 0; i < n; ++i) allocator.construct(memory + i);
    unsigned char bytes[sizeof(float)];
    std::memcpy(bytes, memory + n - 1, sizeof bytes);
    for (const unsigned char b : bytes) EXPECT_EQ(b, 13);
    allocator.deallocate(memory, n);
}

TEST(unwritten, vectors_hold_what_they_are_given) {
    numbers a = {1.0f, 2.0f};
    a.resize(100'000);
    EXPECT_EQ(a.size(), 100'000u);
    EXPECT_TRUE(a[0] == 1.0f && a[1] == 2.0f);
    a.resize(2);
    a.resize(4, 5.0f);
    EXPECT_EQ(a, (numbers{1.0f, 2.0f, 5.0f, 5.0f}));
    const numbers b = a;
    numbers c;
    c = std::move(a);
    EXPECT_EQ(b, c);
}

}  // namespace
