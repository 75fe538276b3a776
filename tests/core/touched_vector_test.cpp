// SPDX-License-Identifier: BSL-1.0
#include <cstddef>

#include <gtest/gtest.h>

#include <gnomon/core/detail/touched_vector.hpp>

namespace {

struct thirteen {
    int value = 13;
    double more[12] = {};
};

TEST(touched_vector, holds_n_default_values) {
    const auto expect = [](std::size_t n, const auto& run) {
        const auto values = gnomon::detail::touched_vector<thirteen>(n, run);
        ASSERT_EQ(values.size(), n);
        for (const thirteen& v : values) ASSERT_TRUE(v.value == 13 && v.more[11] == 0.0);
    };
    for (const std::size_t n : {std::size_t{0}, std::size_t{1}, std::size_t{100'000}}) {
        expect(n, gnomon::sequential{});
        expect(n, gnomon::threads{3});
    }
}

}  // namespace
