// SPDX-License-Identifier: BSL-1.0
/// @file
/// The k nearest neighbors: exact, without the point itself (which is told by its index, so that
/// duplicates of it do count), with a rule for ties at the k-th place (Klasing 2010, Sec. 3.2.2).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// What finds them. The result is the same.
enum class knn_backend : bool {
    leaves,    ///< all points of a leaf at once, see detail/leaf_search.hpp
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
        std::vector<std::uint64_t> begin;
        std::vector<point_index> indices;
        const auto make_room = [&](const position_view<R, Proj>& p, std::size_t ring_size) {
            begin.assign(p.size() + 1, 0);
            for (std::size_t i = 0; i < p.size(); ++i)
                begin[i + 1] = begin[i] + (is_finite(p[i]) ? ring_size : 0);
            indices.resize(begin.back());
        };
        const auto make_visitor = [&] {
            return [&, ring = std::vector<neighbor>()](std::size_t i, const auto& found) mutable {
                found.sort_into(ring);
                for (std::size_t j = 0; j < ring.size(); ++j) indices[begin[i] + j] = ring[j].index;
            };
        };
        if (sweep(points, run, projection, make_visitor, make_room))
            return adjacency(std::move(begin), std::move(indices));
        return adjacency(search(points, std::move(projection)), run);
    }

    /// Calls visit(i, found) for each finite point i, in any order and from several threads, each
    /// with a visitor that make_visitor() gives; before, prepare(position_view, size of all rings).
    /// @return whether it did: not with the other backend, or `tie_rule::all`, or where so many
    ///         points coincide that one point after the other is faster
    /// @throws std::invalid_argument  if k is 0
    template <class R, execution X, class Proj, class Prepare = detail::any_visitor>
        requires point_range<R, Proj>
    [[nodiscard]] bool sweep(const R& points, const X& run, const Proj& projection,
                             auto&& make_visitor, const Prepare& prepare = {}) const {
        detail::require(k > 0, "knn: k must be at least 1");
        if (backend != knn_backend::leaves || ties != tie_rule::by_index) return false;
        const position_view<R, Proj> p(points, projection);
        const detail::leaf_tree tree(p, run);
        if (tree.crowded()) return false;
        if constexpr (!std::is_same_v<Prepare, detail::any_visitor>)
            prepare(p, tree.size() == 0 ? 0 : std::min(k, tree.size() - 1));
        detail::for_each_nearest(tree, k, run, make_visitor);
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
