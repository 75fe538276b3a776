// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/neighborhoods/knn.hpp>

namespace {

TEST(knn, has_the_default_of_the_thesis) { EXPECT_EQ(gnomon::knn{}.k, 50u); }

TEST(knn, gives_k_neighbors_or_all_others) {
    for (const std::size_t n : {0u, 1u, 2u, 3u, 11u, 12u, 100u}) {
        const auto graph = gnomon::knn{.k = 11}(clouds::in_cube(n, 1));
        for (std::size_t i = 0; i < n; ++i)
            EXPECT_EQ(graph[i].size(), std::min<std::size_t>(11, n - 1));
    }
}

/// The query point is excluded by its index: its duplicates are neighbors.
TEST(knn, counts_duplicates_as_neighbors) {
    const clouds::cloud same(60, {1, 2, 3});
    const auto graph = gnomon::knn{.k = 5}(same);
    EXPECT_EQ(std::vector(graph[0].begin(), graph[0].end()),
              (std::vector<gnomon::point_index>{1, 2, 3, 4, 5}));
    EXPECT_EQ(std::vector(graph[59].begin(), graph[59].end()),
              (std::vector<gnomon::point_index>{0, 1, 2, 3, 4}));
    EXPECT_EQ(std::vector(graph[2].begin(), graph[2].end()),
              (std::vector<gnomon::point_index>{0, 1, 3, 4, 5}));
}

/// With all ties, on a grid full of them, the neighborhoods are the same sets in any order of the
/// points.
TEST(knn, with_all_ties_does_not_depend_on_the_order_of_the_points) {
    const auto points = clouds::on_grid(500, 3, 0.1);
    std::vector<std::size_t> order;
    const auto shuffled = clouds::permuted(points, 9, order);
    const gnomon::knn policy{.k = 30, .ties = gnomon::tie_rule::all};
    const auto graph = policy(points);
    const auto graph_of_shuffled = policy(shuffled);
    std::size_t longer = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::set<std::size_t> expected, actual;
        for (const auto j : graph[order[i]]) expected.insert(j);
        for (const auto j : graph_of_shuffled[i]) actual.insert(order[j]);
        ASSERT_EQ(actual, expected);
        longer += expected.size() > 30;
    }
    EXPECT_GT(longer, 100u);
}

TEST(knn, refuses_k_zero) {
    EXPECT_THROW((void)gnomon::knn{.k = 0}(clouds::in_cube(5, 1)), std::invalid_argument);
}

}  // namespace
