// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/neighborhoods/adjacency.hpp>

namespace {

static_assert(gnomon::neighborhood_graph<gnomon::adjacency>);

TEST(adjacency, begins_without_points) { EXPECT_EQ(gnomon::adjacency().size(), 0u); }

TEST(adjacency, keeps_a_note_for_each_point_or_none) {
    const gnomon::neighborhood_note open{.open = true, .certified = false};
    const gnomon::adjacency graph({0, 1, 2}, {1, 0}, {open, {}});
    EXPECT_EQ(graph.note(0), open);
    EXPECT_EQ(graph.note(1), gnomon::neighborhood_note{});
    EXPECT_THROW((void)gnomon::adjacency({0, 1, 2}, {1, 0}, {open}), std::invalid_argument);
}

TEST(adjacency, takes_neighborhoods_that_lie_one_after_the_other) {
    const gnomon::adjacency graph({0, 2, 2, 5}, {1, 2, 0, 1, 2});
    ASSERT_EQ(graph.size(), 3u);
    EXPECT_TRUE(std::ranges::equal(graph[0], std::vector{1, 2}));
    EXPECT_TRUE(graph[1].empty());
    EXPECT_TRUE(std::ranges::equal(graph[2], std::vector{0, 1, 2}));
    EXPECT_EQ(graph.note(2), gnomon::neighborhood_note{});
    EXPECT_EQ(gnomon::adjacency({0}, {}), gnomon::adjacency());
}

TEST(adjacency, refuses_neighborhoods_that_do_not) {
    using begins = std::vector<std::uint64_t>;
    for (const begins& begin : {begins{}, {1}, {0, 1}, {0, 4}, {1, 3}, {0, 2, 1, 3}, {0, 4, 3}})
        EXPECT_THROW((void)gnomon::adjacency(begin, {1, 2, 0}), std::invalid_argument);
    EXPECT_THROW((void)gnomon::adjacency({}, {}), std::invalid_argument);
}

}  // namespace
