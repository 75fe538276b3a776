// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include <gnomon/core/detail/assigned_whole.hpp>

namespace {

/// A number; a copy of 13 fails.
struct number {
    int value = 0;

    number() = default;
    number(const number& other) : value(other.value) {
        if (value == 13) throw std::runtime_error("no memory");
    }
    number(number&&) = default;
    number& operator=(const number& other) {
        value = other.value;  // before it fails
        if (value == 13) throw std::runtime_error("no memory");
        return *this;
    }
    number& operator=(number&&) = default;
    ~number() = default;
};

TEST(assigned_whole, is_as_before_where_copying_fails) {
    gnomon::detail::assigned_whole<number> a, b;
    a.value = 13;
    b.value = 5;
    EXPECT_THROW(b = a, std::runtime_error);
    EXPECT_EQ(b.value, 5);
    a.value = 7;
    b = a;
    EXPECT_EQ(b.value, 7);
}

}  // namespace
