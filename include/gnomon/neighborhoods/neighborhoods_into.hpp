// SPDX-License-Identifier: BSL-1.0
/// @file
/// A stored graph of one scan after another, in the same memory:
///
///     gnomon::neighborhoods_into(graph, index, gnomon::knn{.k = 20}, team);
#pragma once

#include <functional>
#include <utility>

#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// policy(points, run, projection), in the memory of `graph`. Where the policy throws, the graph
/// has no points.
/// @param graph   its content is replaced; its arrays allocate only to grow; a `raster`
///                makes new ones
/// @param points  any point range, or an index of them
/// @param policy  a neighborhood on an index, such as `knn`
/// @throws std::invalid_argument  if the policy's parameters are out of range
/// Complexity: that of the policy.
template <class R, indexed_neighborhood N, execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
void neighborhoods_into(adjacency& graph, const R& points, const N& policy, const X& run = {},
                        Proj projection = {}) {
    if constexpr (detail::needs_no_index<N>) {
        (void)graph.release();
        graph = policy(points, run, projection);
    } else {
        graph = detail::graph_of(policy, points, run, projection, graph.release());
    }
}

}  // namespace gnomon
