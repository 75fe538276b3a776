// SPDX-License-Identifier: BSL-1.0
/// The sorting network of every set of instructions that there is here, against std::sort. Compiled
/// once more for each, see tests/CMakeLists.txt.
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>
#include <gnomon/neighborhoods/detail/sorting_network.hpp>

namespace {

using gnomon::detail::sorting_network, gnomon::detail::with_widest;

constexpr std::size_t longest = 128;

/// Room for the longest list and one more integer.
struct alignas(64) list {
    std::array<std::int32_t, longest + 1> at{};
};

/// Calls visit(n) for the lengths that the network of some instructions sorts.
void for_each_length(auto&& visit) {
    const std::size_t least =
        with_widest([](auto i) { return sorting_network<decltype(i)>::length_for(1); });
    for (std::size_t n = least; n <= longest; n *= 2) visit(n);
}

void sort(list& l, std::size_t n) {
    with_widest([&](auto i) {
        sorting_network<decltype(i)>::sort(l.at.data(), n);
        return true;
    });
}

TEST(sorting_network, has_the_least_power_of_two_of_vectors) {
    for (std::size_t n = 1; n <= longest; ++n) {
        const std::size_t length =
            with_widest([n](auto i) { return sorting_network<decltype(i)>::length_for(n); });
        bool least = true;
        for_each_length([&](std::size_t l) { least = least && (l < n || l >= length); });
        EXPECT_TRUE(length >= n && length <= longest && least) << n;
    }
}

/// A network sorts every list if it sorts every list of zeros and ones (Knuth, The Art of Computer
/// Programming 3, Sec. 5.3.4). Lists of up to 16 are tried all, longer ones of one block of ones,
/// wherever it lies, and at random.
TEST(sorting_network, sorts_zeros_and_ones) {
    gnomon::random_stream random(1);
    for_each_length([&](std::size_t n) {
        const auto expect_sorted = [n](auto&& is_one) {
            list l;
            for (std::size_t i = 0; i < n; ++i) l.at[i] = is_one(i) ? 1 : 0;
            const auto zeros = std::count(l.at.data(), l.at.data() + n, 0);
            sort(l, n);
            ASSERT_TRUE(std::is_sorted(l.at.data(), l.at.data() + n)) << n << " integers";
            ASSERT_EQ(std::count(l.at.data(), l.at.data() + n, 0), zeros) << n << " integers";
        };
        if (n <= 16) {
            for (std::size_t bits = 0; bits < std::size_t{1} << n; ++bits)
                expect_sorted([bits](std::size_t i) { return (bits >> i & 1) != 0; });
        }
        for (std::size_t first = 0; first < n; ++first)
            for (std::size_t end = first; end <= n; ++end)
                expect_sorted([=](std::size_t i) { return i >= first && i < end; });
        for (int trial = 0; trial < 2000; ++trial)
            expect_sorted([&](std::size_t) { return random.below(2) != 0; });
    });
}

TEST(sorting_network, sorts_any_integers) {
    gnomon::random_stream random(2);
    for_each_length([&](std::size_t n) {
        for (const std::uint64_t kinds : {std::uint64_t{3}, std::uint64_t{1} << 32}) {
            list l;
            for (std::size_t i = 0; i < n; ++i)
                l.at[i] =
                    static_cast<std::int32_t>(static_cast<std::uint32_t>(random.bits() % kinds));
            std::vector<std::int32_t> expected(l.at.data(), l.at.data() + n);
            std::sort(expected.begin(), expected.end());
            sort(l, n);
            ASSERT_TRUE(std::equal(expected.begin(), expected.end(), l.at.begin()));
        }
    });
}

/// Equal apart from the three lowest bits, at every place, the integer after the list included.
TEST(sorting_network, finds_equal_successive_integers) {
    for_each_length([](std::size_t n) {
        const auto has_equal = [n](const list& l) {
            return with_widest([&](auto i) {
                return sorting_network<decltype(i)>::has_equal_successors(l.at.data(), n, 7);
            });
        };
        list l;
        for (std::size_t i = 0; i <= n; ++i) l.at[i] = static_cast<std::int32_t>(8 * i + i % 8);
        EXPECT_FALSE(has_equal(l)) << n;
        for (std::size_t i = 0; i < n; ++i) {
            list two = l;
            two.at[i + 1] = two.at[i] ^ 5;
            EXPECT_TRUE(has_equal(two)) << i << " of " << n;
        }
    });
}

}  // namespace
