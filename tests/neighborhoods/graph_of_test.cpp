// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace {

using gnomon::adjacency, gnomon::knn, gnomon::spatial_index;

/// Point i has the i % 4 points after it as neighbors.
gnomon::neighborhood_note find_next_ones(std::size_t i, std::vector<gnomon::neighbor>& found) {
    found.clear();
    for (std::size_t j = 1; j <= i % 4; ++j)
        found.push_back({double(j), static_cast<gnomon::point_index>(i + j)});
    return {.open = i % 2 == 0};
}

TEST(collected_graph, stores_neighborhoods_of_any_length_across_chunks) {
    for (const std::size_t n : {0u, 1u, 1024u, 5000u}) {
        const auto graph =
            gnomon::detail::collected_graph<true>(n, gnomon::threads{3}, find_next_ones);
        ASSERT_EQ(graph.size(), n);
        for (std::size_t i = 0; i < n; ++i) {
            ASSERT_EQ(graph[i].size(), i % 4);
            for (std::size_t j = 0; j < i % 4; ++j) ASSERT_EQ(graph[i][j], i + j + 1);
            ASSERT_EQ(graph.note(i).open, i % 2 == 0);
        }
    }
}

adjacency graph_of_some(const std::vector<bool>& some, const spatial_index& index, std::size_t k,
                        unsigned threads = 1) {
    const auto graph = gnomon::detail::graph_of_some(
        k, [&](std::size_t i) { return bool{some[i]}; }, index, gnomon::threads{threads});
    std::vector<std::uint64_t> begin{0};
    std::vector<gnomon::point_index> indices;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        indices.insert(indices.end(), graph[i].begin(), graph[i].end());
        begin.push_back(indices.size());
    }
    return {std::move(begin), std::move(indices)};
}

/// The neighbors of the wanted points are those of the whole graph, whatever else is wanted.
TEST(graph_of_some, has_the_neighbors_of_knn) {
    gnomon::random_stream random(1);
    for (const clouds::cloud& points :
         {clouds::sheet(3000, 1), clouds::in_cube(2000, 2), clouds::on_grid(2000, 3),
          clouds::in_cube(20, 4), clouds::in_cube(1, 5), clouds::cloud{}}) {
        const spatial_index index(points);
        for (const double share : {0.0, 0.01, 0.3, 1.0}) {
            std::vector<bool> some(points.size());
            for (std::size_t i = 0; i < some.size(); ++i) some[i] = random.uniform() < share;
            for (const std::size_t k : {1u, 5u, 20u, 200u}) {
                const adjacency all = knn{.k = k}(index), found = graph_of_some(some, index, k);
                ASSERT_EQ(found.size(), points.size());
                for (std::size_t i = 0; i < points.size(); ++i) {
                    const auto neighbors = found[i], expected = all[i];
                    ASSERT_EQ(std::vector(neighbors.begin(), neighbors.end()),
                              some[i] ? std::vector(expected.begin(), expected.end())
                                      : std::vector<gnomon::point_index>());
                }
                EXPECT_EQ(graph_of_some(some, index, k, 2), found);
            }
        }
    }
}

TEST(graph_of_some, is_right_where_many_points_coincide) {
    clouds::cloud points = clouds::in_cube(200, 1);
    points.resize(400, Eigen::Vector3d(0.5, 0.5, 0.5));
    const spatial_index index(points);
    std::vector<bool> some(points.size(), false);
    some[7] = some[300] = true;
    const adjacency all = knn{.k = 9}(index), found = graph_of_some(some, index, 9);
    for (const std::size_t i : {7u, 300u})
        EXPECT_EQ(std::vector(found[i].begin(), found[i].end()),
                  std::vector(all[i].begin(), all[i].end()));
    EXPECT_TRUE(found[8].empty());
}

}  // namespace
