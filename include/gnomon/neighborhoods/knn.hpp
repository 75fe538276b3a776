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
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `streaming_neighborhood`. Rings come in canonical order, nearest first; a cloud of n <= k
/// finite points gives rings of n - 1.
struct knn {
    std::size_t k = 50;  ///< number of neighbors, at least 1; the thesis's choice, Sec. 4.4.1
    tie_rule ties = tie_rule::by_index;  ///< `all` for what must not depend on the points' order

    /// The stored graph, which every floor above accepts. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return adjacency(search(points, std::move(projection)), run);
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
