// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/neighborhoods/adjacency.hpp>

namespace {

/// Point i has the i % 4 points after it as neighbors.
struct next_ones {
    std::size_t n;
    [[nodiscard]] std::size_t size() const { return n; }
    void operator()(std::size_t i, std::vector<gnomon::neighbor>& ring) const {
        ring.clear();
        for (std::size_t j = 1; j <= i % 4; ++j) {
            ring.push_back({double(j), static_cast<gnomon::point_index>(i + j)});
        }
    }
};

static_assert(gnomon::neighborhood_graph<gnomon::adjacency>);

TEST(adjacency, stores_rings_of_any_length_across_chunks) {
    for (const std::size_t n : {0u, 1u, 1024u, 5000u}) {
        const gnomon::adjacency graph(next_ones{n}, gnomon::threads{3});
        ASSERT_EQ(graph.size(), n);
        for (std::size_t i = 0; i < n; ++i) {
            ASSERT_EQ(graph[i].size(), i % 4);
            for (std::size_t j = 0; j < i % 4; ++j) ASSERT_EQ(graph[i][j], i + j + 1);
        }
    }
    EXPECT_EQ(gnomon::adjacency().size(), 0u);
}

TEST(adjacency, takes_rings_that_lie_one_after_the_other) {
    const gnomon::adjacency graph({0, 2, 2, 5}, {1, 2, 0, 1, 2});
    ASSERT_EQ(graph.size(), 3u);
    EXPECT_TRUE(std::ranges::equal(graph[0], std::vector{1, 2}));
    EXPECT_TRUE(graph[1].empty());
    EXPECT_TRUE(std::ranges::equal(graph[2], std::vector{0, 1, 2}));
    EXPECT_EQ(graph.note(2), gnomon::ring_note{});
    EXPECT_EQ(gnomon::adjacency({0}, {}), gnomon::adjacency());
}

TEST(adjacency, refuses_rings_that_do_not) {
    using begins = std::vector<std::uint64_t>;
    for (const begins& begin : {begins{}, {1}, {0, 1}, {0, 4}, {1, 3}, {0, 2, 1, 3}, {0, 4, 3}})
        EXPECT_THROW((void)gnomon::adjacency(begin, {1, 2, 0}), std::invalid_argument);
    EXPECT_THROW((void)gnomon::adjacency({}, {}), std::invalid_argument);
}

}  // namespace
