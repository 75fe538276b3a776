// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
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

}  // namespace
