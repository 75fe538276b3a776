// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors: exact, without the point itself (which is told by its index, so that
/// duplicates of it do count), with a rule for ties at the k-th place (Klasing 2010, Sec. 3.2.2).
#pragma once

#include <cstddef>
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
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// What finds them. The result is the same.
enum class knn_backend : bool {
    leaves,    ///< many points at once, see detail/leaf_search.hpp
    nanoflann  ///< one point after the other
};

/// Models `sweeping_neighborhood`. Rings come in canonical order, nearest first; a cloud of n <= k
/// finite points gives rings of n - 1.
struct knn {
    std::size_t k = 50;  ///< number of neighbors, at least 1; the thesis's choice, Sec. 4.4.1
    tie_rule ties = tie_rule::by_index;  ///< `all` for what must not depend on the points' order
    knn_backend backend = knn_backend::leaves;

    /// The stored graph, which every floor above accepts. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::swept_graph(*this, points, run, std::move(projection));
    }

    /// Calls visit(i, found) for each finite point i, in any order and from several threads, each
    /// with a visitor that make_visitor() gives.
    /// @return whether it did: not with the other backend, or where so many points coincide that
    ///         one point after the other is faster
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X, class Proj>
        requires point_range<R, Proj>
    [[nodiscard]] bool sweep(const R& points, const X& run, const Proj& projection,
                             auto&& make_visitor) const {
        detail::require(k > 0, "knn: k must be at least 1");
        if (backend != knn_backend::leaves) return false;
        const auto tree =
            detail::tree_unless_crowded(position_view<R, Proj>(points, projection), run);
        if (!tree) return false;
        detail::sweep_leaves(
            *tree, run, [&] { return detail::leaf_search(*tree, {.k = k, .ties = ties}); },
            make_visitor);
        return true;
    }

    /// A search that stores nothing but its index; the points must outlive it.
    /// @throws std::invalid_argument  if k is 0
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] auto search(const R& points, Proj projection = {}) const {
        detail::require(k > 0, "knn: k must be at least 1");
        return detail::tree_search(*this, points, std::move(projection));
    }

    template <class R, class Proj = std::identity>
    void search(const R&& points, Proj projection = {}) const = delete;

    /// The ring of the finite point i.
    void find(const kd_tree& tree, const auto& points, std::size_t i,
              std::vector<neighbor>& ring) const {
        tree.nearest(points[i], k, i, ring, ties);
    }
};

}  // namespace gnomon
