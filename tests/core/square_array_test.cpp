// SPDX-License-Identifier: BSL-1.0
#include <type_traits>

#include <gtest/gtest.h>

#include <gnomon/core/detail/square_array.hpp>

namespace {

static_assert(std::is_trivially_copyable_v<gnomon::detail::square_array<4>>);
static_assert(sizeof(gnomon::detail::square_array<4>) == 16 * sizeof(double));

TEST(square_array, is_addressed_by_row_and_column) {
    constexpr gnomon::detail::square_array<2> a{{{1.0, 2.0}, {3.0, 4.0}}};
    EXPECT_EQ(a[0][1], 2.0);
    EXPECT_EQ(a[1][0], 3.0);
}

}  // namespace
