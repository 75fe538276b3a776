// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors, but none farther than a radius: `knn` that does not reach across gaps,
/// or `radius` that does not drown in dense places.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Rings come in canonical order, nearest first, and may be empty.
struct hybrid {
    std::size_t k = 50;  ///< at most this many neighbors, at least 1
    double r = 0.30;     ///< and at most this far [m], the distance included

    /// The stored graph. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::swept_graph(*this, points, run, std::move(projection));
    }

    /// Calls visit(i, found) for each finite point i, in any order and from several threads, each
    /// with a visitor that make_visitor() gives.
    /// @return whether it did: not where so many points coincide that one point after the other is
    ///         faster
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <class R, execution X, class Proj>
        requires point_range<R, Proj>
    [[nodiscard]] bool sweep(const R& points, const X& run, const Proj& projection,
                             auto&& make_visitor) const {
        check();
        const auto tree =
            detail::tree_unless_crowded(position_view<R, Proj>(points, projection), run);
        if (!tree) return false;
        const auto make_search = [&] { return detail::leaf_search(*tree, {.k = k, .radius = r}); };
        detail::sweep_leaves(*tree, run, make_search, make_visitor);
        return true;
    }

    /// A search that stores nothing but its index; the points must outlive it.
    /// @throws std::invalid_argument  if k is 0, or r is negative, infinite or NaN
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] auto search(const R& points, Proj projection = {}) const {
        check();
        return detail::tree_search(*this, points, std::move(projection));
    }

    template <class R, class Proj = std::identity>
    void search(const R&& points, Proj projection = {}) const = delete;

    /// The ring of the finite point i.
    void find(const kd_tree& tree, const auto& points, std::size_t i,
              std::vector<neighbor>& ring) const {
        tree.nearest(points[i], k, i, ring);
        while (!ring.empty() && ring.back().squared_distance > r * r) ring.pop_back();
    }

  private:
    void check() const {
        detail::require(k > 0, "hybrid: k must be at least 1");
        detail::require(r >= 0.0 && std::isfinite(r), "hybrid: r must be finite and not negative");
    }
};

}  // namespace gnomon
