// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors of some points only, for who asks after few of many.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/knn.hpp>

namespace gnomon::detail {

/// Models `sweeping_neighborhood`. The rings of the other points are empty, unless so many points
/// coincide that one point after the other is faster: then of all.
struct knn_of_some {
    knn nearest;
    const std::vector<bool>& of;  ///< which points

    template <class R, execution X, class Proj>
    [[nodiscard]] bool sweep(const R& points, const X& run, const Proj& projection,
                             auto&& make_visitor) const {
        require(nearest.k > 0, "knn: k must be at least 1");
        const auto tree = tree_unless_crowded(position_view<R, Proj>(points, projection), run);
        if (!tree) return false;
        const auto make_search = [&] {
            return leaf_search(*tree, {.k = nearest.k, .ties = nearest.ties, .of = &of});
        };
        sweep_leaves(*tree, run, make_search, make_visitor);
        return true;
    }

    template <class R, class Proj>
    [[nodiscard]] auto search(const R& points, Proj projection) const {
        return nearest.search(points, std::move(projection));
    }
};

/// The graph with their rings. O(n log n) for the tree, and O(k log k) for each of them.
template <class R, execution X, class Proj>
[[nodiscard]] adjacency graph_of_some(const knn& nearest, const std::vector<bool>& of,
                                      const R& points, const X& run, Proj projection) {
    return swept_graph(knn_of_some{nearest, of}, points, run, std::move(projection));
}

}  // namespace gnomon::detail
