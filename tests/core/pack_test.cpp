// SPDX-License-Identifier: BSL-1.0
/// What compares packs, against plain loops. Compiled once more for each set of instructions, see
/// tests/CMakeLists.txt.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/random.hpp>

namespace {

using gnomon::detail::pack;

constexpr double unbounded = std::numeric_limits<double>::infinity();

TEST(pack, compares_each_with_the_limit) {
    gnomon::random_stream random(1);
    for (int round = 0; round < 1000; ++round) {
        const double special[] = {0.0, -0.0, 0.5, unbounded, -unbounded, std::nan("")};
        std::array<double, pack::size> a{};
        for (double& x : a) {
            const auto kind = random.below(12);
            x = kind < 6 ? special[kind] : random.uniform();
        }
        for (const double limit : {0.0, 0.5, std::nextafter(0.5, 0.0), unbounded, -unbounded}) {
            std::uint32_t expected = 0;
            for (std::size_t l = 0; l < pack::size; ++l)
                expected |= std::uint32_t{a[l] <= limit} << l;
            ASSERT_EQ(at_most(pack(a.data()), limit), expected);
        }
    }
}

template <class Pack>
void gathers() {
    std::array<double, 100> numbers{};
    for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = 0.5 * static_cast<double>(i);
    std::array<std::uint32_t, Pack::size> places{};
    for (std::uint32_t l = 0; l < Pack::size; ++l) places[l] = (37 * l + 99) % 100;
    const Pack gathered(numbers.data(), places.data());
    double sum = 0.0;
    for (std::size_t l = 0; l < Pack::size; ++l) {
        EXPECT_EQ(gathered[l], numbers[places[l]]);
        sum += numbers[places[l]];
    }
    EXPECT_EQ(gathered.sum(), sum);
}

TEST(pack, gathers_from_places) {
    gathers<pack>();
    gathers<gnomon::detail::slim_pack>();
}

TEST(pack, clamps_each) {
    for (const double x : {-unbounded, -2.0, -0.5, 0.0, 0.25, 0.5, 1.0, unbounded}) {
        std::array<double, pack::size> a{};
        a.back() = x;
        const pack clamped = clamp(pack(a.data()), -0.5, 0.5);
        for (std::size_t l = 0; l < pack::size; ++l)
            EXPECT_EQ(clamped[l], std::clamp(a[l], -0.5, 0.5));
    }
}

}  // namespace
