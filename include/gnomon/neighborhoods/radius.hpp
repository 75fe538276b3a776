// SPDX-License-Identifier: BSL-1.0
/// @file
/// All neighbors within a fixed distance, the distance included: exact, without the point itself.
/// For scans of even density; where density varies, `knn` adapts and this does not.
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
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Neighbors come in canonical order, nearest first; there may be
/// none.
struct radius {
    double r = 0.05;  ///< [m], finite and not negative

    /// The stored graph of points, or of an index of them. It holds n times the mean number of
    /// neighbors, which is large in dense clouds. O(n (log n + m log m)) for m neighbors of each.
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i. O(log n + m log m).
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    template <class Allocator>
    void find(const spatial_index& index, std::size_t i,
              std::vector<neighbor, Allocator>& found) const {
        require_valid();
        detail::search_tree(index.tree(), index[i],
                            {.squared_radius = r * r, .except = static_cast<point_index>(i)},
                            found);
    }

    /// Calls visit(i, found) for each finite point; see `sweeping_neighborhood`.
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    template <execution X>
    void sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        require_valid();
        const auto make_search = [&](const auto& tree) {
            return detail::leaf_balls(tree, [this](std::size_t) { return r; });
        };
        detail::sweep_leaves(index.tree(), run, make_search, make_visitor);
    }

    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    void require_valid() const {
        detail::require(r >= 0.0 && std::isfinite(r), "radius: r must be finite and not negative");
    }
};

}  // namespace gnomon
