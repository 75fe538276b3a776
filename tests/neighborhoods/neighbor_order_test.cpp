// SPDX-License-Identifier: BSL-1.0
/// The order of few neighbors is that of std::sort. Compiled once more for each set of
/// instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/detail/neighbor_order.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace {

using order = gnomon::detail::neighbor_order<>;
using gnomon::neighbor;

void expect_canonical_order(const std::vector<neighbor>& found) {
    std::vector<double> squared;
    for (const neighbor& q : found) squared.push_back(q.squared_distance);
    const order sorted(squared, [&](std::size_t j) { return found[j].index; });
    std::vector<neighbor> expected = found, measured;
    std::sort(expected.begin(), expected.end());
    for (std::size_t rank = 0; rank < found.size(); ++rank) measured.push_back(found[sorted[rank]]);
    ASSERT_EQ(measured, expected) << found.size() << " neighbors";
}

/// For every number of neighbors and several distributions of squared distances: ties, distances
/// that are equal as floats, and squares outside the range of floats.
TEST(neighbor_order, is_canonical) {
    const std::vector<std::pair<std::string, std::function<double(double)>>> models{
        {"even", [](double u) { return u; }},
        {"equal", [](double) { return 0.25; }},
        {"quantized", [](double u) { return std::floor(9 * u) / 9; }},
        {"differ in the last places", [](double u) { return 1 + 1e-15 * std::floor(9 * u); }},
        {"differ in the last places of floats", [](double u) { return 1 + 1e-6 * u; }},
        {"over all decades", [](double u) { return std::pow(10.0, 600 * u - 300); }},
        {"beyond the largest float", [](double u) { return 1e39 * (1 + u); }},
        {"below the least float", [](double u) { return 1e-60 * u; }},
        {"below the least normal double", [](double u) { return 1e-310 * u; }},
        {"zeros among others", [](double u) { return std::max(0.0, u - 0.5); }},
    };
    gnomon::random_stream random(1);
    for (const auto& [name, squared_of] : models) {
        SCOPED_TRACE(name);
        for (std::size_t n = 0; n <= order::most; ++n) {
            std::vector<neighbor> found;
            for (std::size_t j = 0; j < n; ++j) {
                const auto index = static_cast<gnomon::point_index>(n * 7919 * (j + 1) % 1009);
                found.push_back({squared_of(random.uniform()), index});
            }
            expect_canonical_order(found);
        }
    }
}

}  // namespace
