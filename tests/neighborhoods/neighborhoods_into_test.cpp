// SPDX-License-Identifier: BSL-1.0
#include <stdexcept>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/adaptive_knn.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/angularly_sorted.hpp>
#include <gnomon/neighborhoods/delaunay.hpp>
#include <gnomon/neighborhoods/hybrid.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhoods_into.hpp>
#include <gnomon/neighborhoods/radius.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace {

using gnomon::adjacency, gnomon::neighborhoods_into;

/// One graph after another in one memory, with and without notes, of more and of fewer points, of
/// points that coincide, and of none.
template <class N>
void expect_the_graphs_of(const N& policy) {
    adjacency graph;
    for (const clouds::cloud& points :
         {clouds::in_cube(3000, 1), clouds::cloud(300, {1.0, 2.0, 3.0}), clouds::in_cube(500, 2),
          clouds::cloud{}, clouds::in_cube(3000, 3)}) {
        const adjacency expected = policy(points);
        neighborhoods_into(graph, points, policy);
        EXPECT_EQ(graph, expected);
        neighborhoods_into(graph, gnomon::spatial_index(points), policy, gnomon::threads{2});
        EXPECT_EQ(graph, expected);
    }
}

TEST(neighborhoods_into, replaces_any_graph) {
    expect_the_graphs_of(gnomon::knn{.k = 12});
    expect_the_graphs_of(gnomon::knn{.k = 12, .ties = gnomon::tie_rule::all});
    expect_the_graphs_of(gnomon::radius{.r = 0.2});
    expect_the_graphs_of(gnomon::hybrid{});
    expect_the_graphs_of(gnomon::adaptive_knn{});
    expect_the_graphs_of(gnomon::delaunay{});
    expect_the_graphs_of(gnomon::angularly_sorted{gnomon::knn{.k = 12}});
}

TEST(neighborhoods_into, reuses_memory) {
    const gnomon::knn policy{.k = 12};
    adjacency graph = policy(clouds::in_cube(3000, 1));
    const gnomon::point_index* const before = graph[0].data();
    neighborhoods_into(graph, clouds::in_cube(2000, 2), policy);
    EXPECT_EQ(graph[0].data(), before);
}

TEST(neighborhoods_into, takes_points_through_a_projection) {
    struct record {
        int id;
        Eigen::Vector3d xyz;
    };
    std::vector<record> records;
    for (const auto& p : clouds::in_cube(200, 1)) records.push_back({0, p});
    adjacency graph;
    neighborhoods_into(graph, records, gnomon::knn{.k = 5}, gnomon::sequential{}, &record::xyz);
    EXPECT_EQ(graph, gnomon::knn{.k = 5}(clouds::in_cube(200, 1)));
}

TEST(neighborhoods_into, leaves_no_points_where_the_policy_throws) {
    adjacency graph = gnomon::knn{.k = 12}(clouds::in_cube(100, 1));
    EXPECT_THROW(neighborhoods_into(graph, clouds::in_cube(100, 1), gnomon::knn{.k = 0}),
                 std::invalid_argument);
    EXPECT_EQ(graph, adjacency{});
}

}  // namespace
