// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `neighborhood` concept, for any model: yours, too.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace laws {

/// No point is its own neighbor, none is listed twice, none is out of range, and points that are
/// not finite neither have neighbors nor are any.
template <class N>
void rings_are_sets_of_other_finite_points(const N& policy, const clouds::cloud& points) {
    const auto graph = policy(points);
    ASSERT_EQ(graph.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::set<gnomon::point_index> seen;
        for (const gnomon::point_index j : graph[i]) {
            ASSERT_LT(j, points.size());
            ASSERT_NE(j, i);
            ASSERT_TRUE(seen.insert(j).second);
            ASSERT_TRUE(gnomon::is_finite(points[j]) && gnomon::is_finite(points[i]));
        }
    }
}

/// The graph is the same for every execution and through every projection.
template <class N>
void graph_depends_on_points_alone(const N& policy, const clouds::cloud& points) {
    const auto graph = policy(points);
    for (const unsigned t : {1u, 2u, 4u}) ASSERT_EQ(policy(points, gnomon::threads{t}), graph);
    struct record {
        int id;
        Eigen::Vector3d xyz;
    };
    std::vector<record> records;
    for (const auto& p : points) records.push_back({0, p});
    ASSERT_EQ(policy(records, gnomon::sequential{}, &record::xyz), graph);
}

/// The streaming door gives the rings of the stored graph, with their notes.
template <class N>
void both_doors_agree(const N& policy, const clouds::cloud& points) {
    static_assert(gnomon::streaming_neighborhood<N, clouds::cloud>);
    const auto graph = policy(points);
    const auto search = policy.search(points);
    std::vector<gnomon::neighbor> ring;
    for (std::size_t i = 0; i < points.size(); ++i) {
        ASSERT_EQ(gnomon::search_noted(search, i, ring), gnomon::note_of(graph, i));
        ASSERT_EQ(ring.size(), graph[i].size());
        for (std::size_t j = 0; j < ring.size(); ++j) {
            ASSERT_EQ(ring[j].index, graph[i][j]);
            ASSERT_EQ(ring[j].squared_distance,
                      gnomon::squared_distance(points[i], points[ring[j].index]));
        }
    }
}

/// A sweep, where there is one, shows each finite point once, with the ring of the search and what
/// follows from it.
template <class N>
void sweep_agrees(const N& policy, const clouds::cloud& points) {
    static_assert(gnomon::sweeping_neighborhood<N, clouds::cloud>);
    const auto search = policy.search(points);
    std::vector<std::size_t> visits(points.size(), 0);
    std::vector<gnomon::neighbor> ring, expected;
    const auto visit = [&](std::size_t i, const auto& found) {
        ++visits[i];
        search(i, expected);
        found.sort_into(ring);
        EXPECT_EQ(ring, expected) << "point " << i;
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
    if (!policy.sweep(points, gnomon::sequential{}, std::identity{}, [&] { return visit; })) return;
    for (std::size_t i = 0; i < points.size(); ++i)
        ASSERT_EQ(visits[i], gnomon::is_finite(points[i]) ? 1u : 0u);
}

/// Nearest first, ties by index: what policies without an order of their own promise.
template <class N>
void rings_are_in_canonical_order(const N& policy, const clouds::cloud& points) {
    const auto search = policy.search(points);
    std::vector<gnomon::neighbor> ring;
    for (std::size_t i = 0; i < points.size(); ++i) {
        search(i, ring);
        ASSERT_TRUE(std::is_sorted(ring.begin(), ring.end()));
    }
}

template <class N>
void neighborhood_laws(const N& policy, const clouds::cloud& points) {
    rings_are_sets_of_other_finite_points(policy, points);
    graph_depends_on_points_alone(policy, points);
    if constexpr (gnomon::streaming_neighborhood<N, clouds::cloud>)
        both_doors_agree(policy, points);
    if constexpr (gnomon::sweeping_neighborhood<N, clouds::cloud>) sweep_agrees(policy, points);
}

}  // namespace laws
