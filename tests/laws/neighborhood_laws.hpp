// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `neighborhood` concept, for any model: yours, too. Points are seen `from` these
/// view points, which need not be known.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/neighborhood_graph_laws.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace laws {

// [graph_depends_on_points_alone]
/// The graph is the same for every execution and through every projection.
template <class N>
void graph_depends_on_points_alone(const N& policy, const clouds::cloud& points,
                                   const gnomon::viewpoint_table& from = {}) {
    const auto seen = gnomon::with_viewpoints(points, from);
    const auto graph = policy(seen);
    for (const unsigned t : {1u, 2u, 4u}) ASSERT_EQ(policy(seen, gnomon::threads{t}), graph);
    struct record {
        int id;
        Eigen::Vector3d xyz;
    };
    std::vector<record> records;
    for (const auto& p : points) records.push_back({0, p});
    ASSERT_EQ(policy(gnomon::with_viewpoints(records, from), gnomon::sequential{}, &record::xyz),
              graph);
}
// [graph_depends_on_points_alone]

// [find_agrees_with_graph]
/// The neighbors of one point are those of the stored graph, in the same order and with the same
/// note; so are those of the graph of an index.
template <gnomon::indexed_neighborhood N>
void find_agrees_with_graph(const N& policy, const clouds::cloud& points,
                            const gnomon::viewpoint_table& from = {}) {
    const gnomon::spatial_index index(gnomon::with_viewpoints(points, from));
    const auto graph = policy(gnomon::with_viewpoints(points, from));
    ASSERT_EQ(policy(index), graph);
    std::vector<gnomon::neighbor> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(gnomon::detail::find_noted(policy, index, i, found),
                  gnomon::detail::note_of(graph, i));
        ASSERT_EQ(found.size(), graph[i].size());
        for (std::size_t j = 0; j < found.size(); ++j) {
            ASSERT_EQ(found[j].index, graph[i][j]);
            ASSERT_EQ(found[j].squared_distance,
                      gnomon::squared_distance(points[i], points[found[j].index]));
        }
    }
}
// [find_agrees_with_graph]

// [sweep_agrees_with_find]
/// A sweep visits each finite point once, with the neighbors that `find` returns, and with their
/// moments and mean distance.
template <gnomon::sweeping_neighborhood N>
void sweep_agrees_with_find(const N& policy, const clouds::cloud& points,
                            const gnomon::viewpoint_table& from = {}) {
    const gnomon::spatial_index index(gnomon::with_viewpoints(points, from));
    std::vector<std::size_t> visits(points.size(), 0);
    std::vector<gnomon::neighbor> neighbors, expected;
    const auto visit = [&](std::size_t i, const auto& found) {
        ++visits[i];
        policy.find(index, i, expected);
        found.sort_into(neighbors);
        EXPECT_EQ(neighbors, expected) << "point " << i;
        const auto sums = found.summed();
        gnomon::moments moments;
        double distance = 0.0;
        for (const gnomon::neighbor& q : expected) {
            moments.add(points[q.index] - points[i]);
            distance += std::sqrt(q.squared_distance) / static_cast<double>(expected.size());
        }
        EXPECT_EQ(sums.about_point.count, expected.size());
        const double n = static_cast<double>(expected.size());
        EXPECT_LE((sums.about_point.sum - moments.sum).norm(), 1e-12 * n * distance);
        EXPECT_LE((sums.about_point.outer - moments.outer).norm(), 1e-12 * moments.outer.norm());
        EXPECT_NEAR(sums.mean_distance, distance, 1e-12 * distance);
    };
    policy.sweep(index, gnomon::sequential{}, [&] { return visit; });
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_EQ(visits[i], gnomon::is_finite(points[i]) ? 1u : 0u);
}
// [sweep_agrees_with_find]

/// Nearest first, ties by index, which policies without an order of their own promise.
template <gnomon::indexed_neighborhood N>
void neighbors_are_in_canonical_order(const N& policy, const clouds::cloud& points,
                                      const gnomon::viewpoint_table& from = {}) {
    const gnomon::spatial_index index(gnomon::with_viewpoints(points, from));
    std::vector<gnomon::neighbor> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        gnomon::detail::find_noted(policy, index, i, found);
        ASSERT_TRUE(std::is_sorted(found.begin(), found.end()));
    }
}

template <class N>
void neighborhood_laws(const N& policy, const clouds::cloud& points,
                       const gnomon::viewpoint_table& from = {}) {
    graph_lists_other_finite_points(policy(gnomon::with_viewpoints(points, from)), points);
    graph_depends_on_points_alone(policy, points, from);
    if constexpr (gnomon::indexed_neighborhood<N>) find_agrees_with_graph(policy, points, from);
    if constexpr (gnomon::sweeping_neighborhood<N>) sweep_agrees_with_find(policy, points, from);
}

}  // namespace laws
