// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/neighborhoods/knn.hpp>

#include "laws/clouds.hpp"

namespace {

TEST(knn, has_the_default_of_the_thesis) { EXPECT_EQ(gnomon::knn{}.k, 50u); }

TEST(knn, gives_k_neighbors_or_all_others) {
    for (const std::size_t n : {0u, 1u, 2u, 3u, 11u, 12u, 100u}) {
        const auto graph = gnomon::knn{.k = 11}(clouds::in_cube(n, 1));
        for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(graph[i].size(), std::min<std::size_t>(11, n - 1));
    }
}

/// The self is told by its index: duplicates of a point are neighbors of it.
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

TEST(knn, refuses_k_zero) {
    EXPECT_THROW((void)gnomon::knn{.k = 0}(clouds::in_cube(5, 1)), std::invalid_argument);
}

}  // namespace
