// SPDX-License-Identifier: BSL-1.0
/// @file
/// The laws of the `neighborhood_graph` concept, for any model: yours, too.
#pragma once

#include <cstddef>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace laws {

// [graph_lists_other_finite_points]
/// There is a list for each point. It names neither the point itself, nor a point twice, nor one
/// that does not exist; points that are not finite have no neighbors and are no
/// neighbors.
template <gnomon::neighborhood_graph G>
void graph_lists_other_finite_points(const G& graph, const clouds::cloud& points) {
    ASSERT_EQ(graph.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        std::set<gnomon::point_index> seen;
        for (const gnomon::point_index j : graph[i]) {
            ASSERT_LT(j, points.size());
            ASSERT_NE(j, i);
            ASSERT_TRUE(seen.insert(j).second);
            ASSERT_TRUE(gnomon::is_finite(points[j]) && gnomon::is_finite(points[i]));
        }
        ASSERT_EQ(seen.size(), std::ranges::size(graph[i]));
    }
}
// [graph_lists_other_finite_points]

}  // namespace laws
