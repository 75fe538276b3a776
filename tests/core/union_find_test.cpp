// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>

namespace {

struct edge {
    gnomon::point_index i, j;
};

std::vector<edge> random_edges(std::size_t n, std::size_t m, std::uint64_t seed) {
    gnomon::random_stream random(seed);
    std::vector<edge> edges(m);
    for (edge& e : edges) {
        e.i = static_cast<gnomon::point_index>(random.below(n));
        e.j = static_cast<gnomon::point_index>(random.below(n));
    }
    return edges;
}

/// The smallest node that each node is connected to, by relaxation to a fixed point.
std::vector<gnomon::point_index> smallest_reachable(std::size_t n, const std::vector<edge>& edges) {
    std::vector<gnomon::point_index> label(n);
    for (std::size_t i = 0; i < n; ++i) label[i] = static_cast<gnomon::point_index>(i);
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto [i, j] : edges) {
            const auto low = std::min(label[i], label[j]);
            changed = changed || label[i] != low || label[j] != low;
            label[i] = label[j] = low;
        }
    }
    return label;
}

TEST(union_find, finds_the_smallest_element_of_each_component_on_any_number_of_threads) {
    constexpr std::size_t n = 5000;
    for (const std::size_t m : {0u, 1000u, 2500u, 4000u, 20'000u}) {
        const auto edges = random_edges(n, m, m);
        const auto expected = smallest_reachable(n, edges);
        for (const unsigned t : {1u, 2u, 4u}) {
            gnomon::detail::union_find sets(n);
            gnomon::detail::for_each_chunk(gnomon::threads{t}, m,
                                           [&](std::size_t begin, std::size_t end) {
                                               for (std::size_t e = begin; e < end; ++e)
                                                   sets.unite(edges[e].i, edges[e].j);
                                           });
            for (std::size_t i = 0; i < n; ++i) {
                ASSERT_EQ(sets.find(static_cast<gnomon::point_index>(i)), expected[i]);
            }
        }
    }
}

TEST(union_find, is_used_again_and_moved) {
    gnomon::detail::union_find sets(100);
    for (const std::size_t n : {100u, 7u, 100u, 300u}) {
        sets.reset(n);
        ASSERT_EQ(sets.size(), n);
        const auto last = static_cast<gnomon::point_index>(n - 1);
        for (gnomon::point_index i = 0; i <= last; ++i) ASSERT_EQ(sets.find(i), i);
        EXPECT_EQ(sets.unite(last, 2), 2u);
        gnomon::detail::union_find other = std::move(sets);
        EXPECT_EQ(other.find(last), 2u);
        sets.reset(3);  // a moved-from one
        EXPECT_EQ(sets.find(2), 2u);
        sets = std::move(other);
        EXPECT_EQ(sets.find(last), 2u);
    }
}

TEST(union_find, knows_whether_all_are_singletons) {
    gnomon::detail::union_find sets(3);
    EXPECT_TRUE(sets.is_of_singletons());
    sets.unite(2, 1);
    EXPECT_FALSE(sets.is_of_singletons());
    sets.reset(3);
    EXPECT_TRUE(sets.is_of_singletons());
    EXPECT_TRUE(gnomon::detail::union_find().is_of_singletons());
}

TEST(union_find, of_nothing_is_nothing) { EXPECT_EQ(gnomon::detail::union_find(0).size(), 0u); }

}  // namespace
