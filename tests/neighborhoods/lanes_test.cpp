// SPDX-License-Identifier: BSL-1.0
/// What vector instructions do, against plain loops. Compiled once more for each set of
/// instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/lanes.hpp>

namespace {

using gnomon::detail::lane_count, gnomon::detail::lanes;

constexpr float beyond_all = std::numeric_limits<float>::infinity();

/// Random numbers among which are zeros of both signs, equal ones, infinities and NaN.
lanes any_lanes(gnomon::random_stream& random) {
    lanes a{};
    for (std::size_t l = 0; l < lane_count; ++l) {
        const float special[] = {0.0f, -0.0f, 0.5f, beyond_all, -beyond_all, std::nanf("")};
        const auto kind = random.bits() % 12;
        a[l] = kind < 6 ? special[kind] : static_cast<float>(random.uniform());
    }
    return a;
}

std::uint32_t at_most_one_by_one(const lanes& a, float limit) {
    std::uint32_t bits = 0;
    for (std::size_t l = 0; l < lane_count; ++l) bits |= std::uint32_t{a[l] <= limit} << l;
    return bits;
}

TEST(lanes, compare_each_with_the_limit) {
    gnomon::random_stream random(1);
    for (std::size_t trial = 0; trial < 2000; ++trial) {
        const lanes a = any_lanes(random);
        for (const float limit : {0.0f, -0.0f, 0.5f, a[trial % 32], beyond_all, std::nanf("")}) {
            ASSERT_EQ(gnomon::detail::at_most(a, limit), at_most_one_by_one(a, limit));
            ASSERT_EQ(gnomon::detail::count_at_most(a, limit),
                      std::bitset<32>(at_most_one_by_one(a, limit)).count());
        }
    }
}

/// No, all, single and random ones of the 32; nothing is written beyond 32.
TEST(lanes, keep_those_whose_bits_are_set) {
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
        auto* const end = gnomon::detail::compress(numbers.data(), set, kept.data());
        const std::size_t n =
            gnomon::detail::compress(values, 100, set, kept_values.data(), places.data());
        ASSERT_EQ(n, expected_values.size());
        ASSERT_EQ(std::vector(kept.data(), end), expected_numbers);
        EXPECT_TRUE(kept[32] == 9 && places[32] == 9 && kept_values[32] == -1.0f);
        kept_values.resize(n);
        places.resize(n);
        ASSERT_EQ(kept_values, expected_values);
        ASSERT_EQ(places, expected_places);
    }
}

/// Distances of points, and of boxes about them: never more than from any point of the box.
TEST(lanes, measure_points_and_boxes) {
    gnomon::random_stream random(3);
    const auto any = [&] { return static_cast<float>(random.uniform()); };
    for (int trial = 0; trial < 200; ++trial) {
        gnomon::detail::lane_points points;
        gnomon::detail::lane_boxes boxes;
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float x = any(), y = any(), z = any();
            points.set(l, {x, y, z});
            boxes.set(l, {x, y, z}, {0.25f, 0.5f, 0.0f});
        }
        const float px = any(), py = any(), pz = any();
        const lanes d2 = points.squared_distances(px, py, pz);
        const lanes gap2 = boxes.squared_distances_times_4(px, py, pz);
        for (std::size_t l = 0; l < lane_count; ++l) {
            const float dx = points.x[l] - px, dy = points.y[l] - py, dz = points.z[l] - pz;
            ASSERT_NEAR(d2[l], dx * dx + dy * dy + dz * dz, 1e-6);
            const float gx = std::max(0.0f, std::abs(dx) - 0.25f);
            const float gy = std::max(0.0f, std::abs(dy) - 0.5f);
            ASSERT_NEAR(gap2[l], 4 * (gx * gx + gy * gy + dz * dz), 4e-6);
        }
    }
}

}  // namespace
