// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/recognition/average_linkage.hpp>

namespace rec = gnomon::recognition;

namespace {

using distances = std::vector<std::vector<double>>;

/// Of points in the plane, in some heaps.
distances of_heaps(std::size_t n, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<std::pair<double, double>> at;
    for (std::size_t i = 0; i < n; ++i) {
        const double heap = 3.0 * std::floor(4.0 * random.uniform());
        at.emplace_back(heap + random.gaussian(), random.gaussian());
    }
    distances d(n, std::vector<double>(n, 0.0));
    for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j)
            d[i][j] = std::hypot(at[i].first - at[j].first, at[i].second - at[j].second);
    return d;
}

/// The definition: always the two groups of least mean distance.
std::vector<std::size_t> by_definition(const distances& d, double limit) {
    std::vector<std::vector<std::size_t>> groups;
    for (std::size_t i = 0; i < d.size(); ++i) groups.push_back({i});
    const auto mean = [&](const auto& a, const auto& b) {
        double sum = 0.0;
        for (const std::size_t i : a)
            for (const std::size_t j : b) sum += d[i][j];
        return sum / static_cast<double>(a.size() * b.size());
    };
    while (groups.size() > 1) {
        std::size_t first = 0, second = 1;
        for (std::size_t a = 0; a < groups.size(); ++a)
            for (std::size_t b = a + 1; b < groups.size(); ++b)
                if (mean(groups[a], groups[b]) < mean(groups[first], groups[second]))
                    first = a, second = b;
        if (mean(groups[first], groups[second]) > limit) break;
        groups[first].insert(groups[first].end(), groups[second].begin(), groups[second].end());
        groups.erase(groups.begin() + static_cast<std::ptrdiff_t>(second));
    }
    std::vector<std::size_t> result(d.size());
    for (auto& g : groups) std::sort(g.begin(), g.end());
    std::sort(groups.begin(), groups.end());
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const std::size_t i : groups[g]) result[i] = g;
    return result;
}

TEST(average_linkage, is_what_its_definition_says) {
    for (std::uint64_t seed = 1; seed < 30; ++seed) {
        const auto d = of_heaps(5 + seed, seed);
        for (const double limit : {0.0, 0.4, 1.0, 2.0, 3.5, 20.0})
            EXPECT_EQ(rec::average_linkage(
                          d.size(), [&](std::size_t i, std::size_t j) { return d[i][j]; }, limit),
                      by_definition(d, limit))
                << seed << ", " << limit;
    }
}

TEST(average_linkage, makes_one_group_of_equal_samples_and_none_of_nothing) {
    const auto zero = [](std::size_t, std::size_t) { return 0.0; };
    EXPECT_TRUE(rec::average_linkage(0, zero, 1.0).empty());
    EXPECT_EQ(rec::average_linkage(1, zero, 1.0), std::vector<std::size_t>{0});
    EXPECT_EQ(rec::average_linkage(40, zero, 0.0), std::vector<std::size_t>(40, 0));
    std::vector<std::size_t> alone(7);
    std::iota(alone.begin(), alone.end(), std::size_t{0});
    EXPECT_EQ(rec::average_linkage(7, zero, -1.0), alone);
}

TEST(average_linkage, refuses_distances_that_are_not_finite) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        EXPECT_THROW((void)rec::average_linkage(
                         3, [bad](std::size_t i, std::size_t) { return i == 2 ? bad : 1.0; }, 1.0),
                     std::invalid_argument);
}

}  // namespace
