// SPDX-License-Identifier: BSL-1.0
/// Every set of instructions that there is here, against plain loops. Compiled once more for each,
/// see tests/CMakeLists.txt.
#include <bitset>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/lane_instructions.hpp>

namespace {

using gnomon::detail::compiled_instructions, gnomon::detail::plain_instructions;
using gnomon::detail::lane_count, gnomon::detail::lanes;

constexpr float beyond_all = std::numeric_limits<float>::infinity();

/// Random numbers among which are zeros of both signs, equal ones, infinities and NaN.
lanes any_lanes(gnomon::random_stream& random) {
    lanes a{};
    for (std::size_t l = 0; l < lane_count; ++l) {
        const float special[] = {0.0f, -0.0f, 0.5f, beyond_all, -beyond_all, std::nanf("")};
        const auto kind = random.below(12);
        a[l] = kind < 6 ? special[kind] : static_cast<float>(random.uniform());
    }
    return a;
}

std::uint32_t at_most_one_by_one(const lanes& a, float limit) {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < lane_count; ++l) bits |= std::uint32_t{a[l] <= limit} << l;
    return bits;
}

void expect_comparisons(auto instructions) {
    gnomon::random_stream random(1);
    for (std::size_t trial = 0; trial < 2000; ++trial) {
        const lanes a = any_lanes(random);
        for (const float limit : {0.0f, -0.0f, 0.5f, a[trial % 32], beyond_all, std::nanf("")}) {
            ASSERT_EQ(instructions.at_most(a, limit), at_most_one_by_one(a, limit));
            ASSERT_EQ(instructions.count_at_most(a, limit),
                      std::bitset<32>(at_most_one_by_one(a, limit)).count());
        }
    }
}

/// Of no, all, single and random ones of the 32; nothing is written beyond 32.
void expect_compression(auto instructions) {
    gnomon::random_stream random(2);
    std::vector<std::uint32_t> sets{0, ~std::uint32_t{0}};
    for (int l = 0; l < 32; ++l) sets.push_back(std::uint32_t{1} << l);
    for (int i = 0; i < 2000; ++i) sets.push_back(static_cast<std::uint32_t>(random.bits()));
    lanes values{};
    std::vector<std::uint32_t> numbers(lane_count);
    for (std::uint32_t l = 0; l < lane_count; ++l) {
        values[l] = static_cast<float>(l) + 0.5f;
        numbers[l] = 7 * l;
    }
    for (const std::uint32_t set : sets) {
        std::vector<float> expected_values;
        std::vector<std::uint32_t> expected_numbers, expected_places;
        for (std::uint32_t l = 0; l < lane_count; ++l) {
            if ((set >> l & 1) == 0) continue;
            expected_values.push_back(values[l]);
            expected_numbers.push_back(numbers[l]);
            expected_places.push_back(100 + l);
        }
        std::vector<float> kept_values(lane_count + 1, -1.0f);
        std::vector<std::uint32_t> kept(lane_count + 1, 9), places(lane_count + 1, 9);
        auto* const end = instructions.compress(numbers.data(), set, kept.data());
        const std::size_t n =
            instructions.compress(values, 100, set, kept_values.data(), places.data());
        ASSERT_EQ(n, expected_values.size());
        ASSERT_EQ(std::vector(kept.data(), end), expected_numbers);
        EXPECT_TRUE(kept[32] == 9 && places[32] == 9 && kept_values[32] == -1.0f);
        std::vector<float> values_alone(lane_count + 1, -1.0f);
        auto* const last = instructions.compress(values.at, set, values_alone.data());
        ASSERT_EQ(std::vector(values_alone.data(), last), expected_values);
        EXPECT_EQ(values_alone[32], -1.0f);
        kept_values.resize(n);
        places.resize(n);
        ASSERT_EQ(kept_values, expected_values);
        ASSERT_EQ(places, expected_places);
    }
}

TEST(lane_instructions, compare_each_with_the_limit) {
    expect_comparisons(plain_instructions{});
    expect_comparisons(compiled_instructions{});
}

TEST(lane_instructions, keep_those_whose_bits_are_set) {
    expect_compression(plain_instructions{});
    expect_compression(compiled_instructions{});
}

/// The widest instruction set is chosen by the processor, not by compiler flags.
TEST(lane_instructions, are_the_widest_that_there_are) {
#if defined(GNOMON_LANES_UP_TO_AVX2)
    using gnomon::detail::avx2_instructions;
    if (gnomon::detail::has_avx2()) {
        expect_comparisons(avx2_instructions{});
        expect_compression(avx2_instructions{});
    }
    const bool expected = gnomon::detail::has_avx2();
#else
    using avx2_instructions = compiled_instructions;
    const bool expected = true;
#endif
    const bool are_used = gnomon::detail::with_widest([](auto instructions) {
        return std::is_same_v<decltype(instructions), avx2_instructions>;
    });
    EXPECT_EQ(are_used, expected);
}

}  // namespace
