// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors within a radius: `knn` that does not reach across gaps, or `radius` with
/// a bounded number of neighbors in dense places.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
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

/// Models `sweeping_neighborhood`. Neighbors come in canonical order, nearest first; there may be
/// none.
struct hybrid {
    std::size_t k = 50;  ///< the largest number of neighbors, at least 1
    double r = 0.30;     ///< and at most this far [m], the distance included

    /// The stored graph of points, or of an index of them. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i. O(log n + k log k).
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        require_valid();
        detail::search_tree(
            index.tree(), index[i],
            {.k = k, .squared_radius = r * r, .except = static_cast<point_index>(i)}, found);
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        require_valid();
        detail::sweep_nearest(index.tree(), {.k = k, .radius = r}, run, make_visitor);
    }

    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    void require_valid() const {
        detail::require(k > 0, "hybrid: k must be at least 1");
        detail::require(r >= 0.0 && std::isfinite(r), "hybrid: r must be finite and not negative");
    }
};

}  // namespace gnomon
