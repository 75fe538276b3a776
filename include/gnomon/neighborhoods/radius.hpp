// SPDX-License-Identifier: BSL-1.0
/// @file
/// All neighbors within a fixed distance, the distance included: exact, without the point itself.
/// For scans of even density; where density varies, `knn` adapts and this does not.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_balls.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `sweeping_neighborhood`. Rings come in canonical order, nearest first, and may be empty.
struct radius {
    double r = 0.05;  ///< [m], finite and not negative

    /// The stored graph. Its size is n times the mean number of neighbors: mind dense clouds.
    /// O(n (log n + m log m)) for m neighbors of each.
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::swept_graph(*this, points, run, std::move(projection));
    }

    /// Calls visit(i, found) for each finite point i, in any order and from several threads, each
    /// with a visitor that make_visitor() gives.
    /// @return true
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
    template <class R, execution X, class Proj>
        requires point_range<R, Proj>
    [[nodiscard]] bool sweep(const R& points, const X& run, const Proj& projection,
                             auto&& make_visitor) const {
        check();
        const detail::leaf_tree tree(position_view<R, Proj>(points, projection), run);
        const auto make_search = [&] {
            return detail::leaf_balls(tree, [this](std::size_t) { return r; });
        };
        detail::sweep_leaves(tree, run, make_search, make_visitor);
        return true;
    }

    /// A search that stores nothing but its index; the points must outlive it.
    /// @throws std::invalid_argument  if r is negative, infinite or NaN
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
        ring.clear();
        tree.for_each_within(points[i], r, [&](const neighbor& q) {
            if (q.index != i) ring.push_back(q);
        });
        std::sort(ring.begin(), ring.end());
    }

  private:
    void check() const {
        detail::require(r >= 0.0 && std::isfinite(r), "radius: r must be finite and not negative");
    }
};

}  // namespace gnomon
