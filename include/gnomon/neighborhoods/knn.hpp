// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors: exact, without the point itself, which is recognised by its index, so
/// that duplicates of it count; with a rule for ties at the k-th place.
///
/// Klasing 2010, Sec. 3.2.2; metrics and (1 + eps) search App. A.1.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Neighbors come in canonical order, nearest first; in a cloud of
/// n <= k finite points each has n - 1.
struct knn {
    std::size_t k = 50;  ///< number of neighbors, at least 1; the thesis's choice, Sec. 4.4.1
    tie_rule ties = tie_rule::by_index;  ///< `all` for what must not depend on the points' order

    /// The stored graph of points, or of an index of them. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i. O(log n + k log k).
    /// @throws std::invalid_argument  if k is 0
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        require_valid();
        detail::search_tree(index.tree(), index[i],
                            {.k = k, .ties = ties, .except = static_cast<point_index>(i)}, found);
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// @throws std::invalid_argument  if k is 0
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        require_valid();
        detail::sweep_nearest(index.tree(), {.k = k, .ties = ties}, run, make_visitor);
    }

    /// The number of neighbors of each of n finite points; nothing if ties may add to it.
    [[nodiscard]] std::optional<std::size_t> neighbors_of_each(std::size_t n) const {
        if (ties != tie_rule::by_index) return std::nullopt;
        return std::min(k, n - std::min<std::size_t>(n, 1));
    }

    /// @throws std::invalid_argument  if k is 0
    void require_valid() const { detail::require(k > 0, "knn: k must be at least 1"); }
};

}  // namespace gnomon
