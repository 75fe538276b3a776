// SPDX-License-Identifier: BSL-1.0
/// What leaves find within radii is what nanoflann finds one by one. Compiled once more for each
/// set of instructions, see tests/CMakeLists.txt.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "neighborhoods/sweep_clouds.hpp"
#include "oracles/nanoflann_index.hpp"
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/radius.hpp>

namespace {

using gnomon::adjacency, gnomon::hybrid, gnomon::radius;
using gnomon::detail::leaf_balls, gnomon::detail::leaf_tree;

/// Radii with almost no neighbors, and radii that equal the distance of a neighbor.
std::vector<double> radii_for(const clouds::cloud& points) {
    std::vector<double> all{0.0};
    const auto some = std::find_if(points.begin(), points.end(),
                                   [](const auto& p) { return gnomon::is_finite(p); });
    if (some == points.end()) return all;
    const auto neighbors = gnomon::spatial_index(points).nearest(*some, 12);
    for (const std::size_t k : {1u, 11u})
        if (k < neighbors.size()) all.push_back(std::sqrt(neighbors[k].squared_distance));
    std::erase_if(all, [](double r) { return r > 1e140; });  // all pairs of 1500
    return all;
}

void expect_equal(const clouds::cloud& points, const adjacency& found, const adjacency& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_TRUE(std::ranges::equal(found[i], expected[i])) << "point " << i;
}

TEST(leaf_balls, match_nanoflann) {
    for (const auto& [name, points] : clouds::to_sweep()) {
        for (const double r : radii_for(points)) {
            SCOPED_TRACE(name + ", r " + std::to_string(r));
            expect_equal(points, radius{r}(points), oracles::graph_within(points, r));
            for (const std::size_t k : {2u, 30u})
                expect_equal(points, hybrid{k, r}(points), oracles::graph_within(points, r, k));
        }
    }
}

/// Radii that differ from point to point by a lot, none, and infinite ones.
TEST(leaf_balls, accept_a_radius_for_each_point) {
    const auto radius_of = [](std::size_t i) {
        if (i % 11 == 0) return -1.0;
        if (i % 101 == 0) return std::numeric_limits<double>::infinity();
        return std::pow(2.0, -double(i % 13)) * 0.1;
    };
    for (const auto& points : {clouds::in_cube(1500, 1), clouds::on_grid(1500, 2, 0.05)}) {
        const leaf_tree tree(gnomon::position_view<clouds::cloud>(points), gnomon::sequential{});
        std::vector<std::vector<std::uint32_t>> found(points.size());
        std::size_t visited = 0;
        const auto visit = [&](std::size_t p, std::span<const std::uint32_t> places) {
            auto& neighbors = found[tree.index()[p]];
            for (const std::uint32_t q : places) neighbors.push_back(tree.index()[q]);
            std::sort(neighbors.begin(), neighbors.end());
            ++visited;
        };
        leaf_balls search(tree, [&](std::size_t p) { return radius_of(tree.index()[p]); });
        for (std::size_t g = 0; g < tree.groups(); ++g) search(g, visit);
        for (std::size_t i = 0; i < points.size(); ++i) {
            const double r = radius_of(i);
            std::vector<std::uint32_t> expected;
            for (std::size_t j = 0; j < points.size(); ++j)
                if (j != i && r >= 0.0 && gnomon::squared_distance(points[i], points[j]) <= r * r)
                    expected.push_back(static_cast<std::uint32_t>(j));
            ASSERT_EQ(found[i], expected) << i;
        }
        EXPECT_EQ(visited, points.size() - (points.size() + 10) / 11);
    }
}

TEST(leaf_balls, are_the_same_for_any_number_of_threads) {
    const auto points = clouds::on_grid(9000, 4, 0.05);
    const auto all = radius{0.2}(points), some = hybrid{7, 0.2}(points);
    for (const unsigned t : {1u, 2u, 4u}) {
        EXPECT_EQ(radius{0.2}(points, gnomon::threads{t}), all);
        EXPECT_EQ((hybrid{7, 0.2}(points, gnomon::threads{t})), some);
    }
}

}  // namespace
