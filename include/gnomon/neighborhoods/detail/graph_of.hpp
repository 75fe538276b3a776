// SPDX-License-Identifier: BSL-1.0
/// @file
/// The stored graph of an indexed neighborhood: what operator() of all of them does.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/detail/scratch_graph.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// The graph of n points of which find(i, found) finds the neighbors, and returns their note. The
/// indices exist twice while it is built.
/// @tparam Notes   whether the graph stores the notes; not in a `scratch_graph`
/// @tparam Buffer  the vector that `find` takes
template <bool Notes, class Graph = adjacency, class Buffer = std::vector<neighbor>, execution X>
[[nodiscard]] Graph collected_graph(std::size_t n, const X& run, auto&& find) {
    typename vectors_of<Graph>::begins begin(n + 1, 0);
    std::vector<neighborhood_note> notes;
    if constexpr (Notes) notes.resize(n);
    scratch<scratch<point_index>> indices_of_chunk(chunk_count(n));
    for_each_chunk(run, n, [&](std::size_t first, std::size_t last) {
        scratch<point_index>& indices = indices_of_chunk[first / chunk_size];
        Buffer found;
        for (std::size_t i = first; i < last; ++i) {
            const neighborhood_note note = find(i, found);
            if constexpr (Notes) notes[i] = note;
            begin[i + 1] = found.size();
            for (const neighbor& q : found) indices.push_back(q.index);
        }
    });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    typename vectors_of<Graph>::indices indices;
    indices.reserve(begin.back());
    for (scratch<point_index>& chunk : indices_of_chunk) {
        indices.insert(indices.end(), chunk.begin(), chunk.end());
        scratch<point_index>().swap(chunk);
    }
    if constexpr (Notes)
        return Graph(std::move(begin), std::move(indices), std::move(notes));
    else
        return Graph(std::move(begin), std::move(indices));
}

/// `knn` of some points only; the other points have no neighbors in the graph.
struct knn_of_some {
    nearest_wanted wanted;

    template <execution X>
    [[nodiscard]] bool sweep(const spatial_index& index, const X& run, auto&& make_visitor) const {
        return sweep_nearest(index.tree(), wanted, run, make_visitor);
    }
};

/// The graph with the k nearest neighbors of the points i for which wanted(i) holds, nearest first.
/// O(n / 32), and O(k log k) for each of them.
template <execution X>
[[nodiscard]] scratch_graph graph_of_some(std::size_t k, auto&& wanted, const spatial_index& index,
                                          const X& run) {
    place_set some;
    some.assign_if(index.tree(), wanted);
    if (auto swept = recorded_graph<scratch_graph>(knn_of_some{{.k = k, .of = &some}}, index, run))
        return *std::move(swept);
    return collected_graph<false, scratch_graph, scratch<neighbor>>(
        index.size(), run, [&](std::size_t i, scratch<neighbor>& found) {
            found.clear();
            const point_index place = index.tree().place_of(i);
            if (place != leaf_tree::no_place && some.contains(place)) {
                search_tree(index.tree(), index[i], {.k = k, .except = static_cast<point_index>(i)},
                            found);
            }
            return neighborhood_note{};
        });
}

/// The graph of a neighborhood over points, or over an index of them.
template <indexed_neighborhood N, class R, execution X, class Proj>
[[nodiscard]] adjacency graph_of(const N& policy, const R& points, const X& run,
                                 const Proj& projection) {
    require_valid(policy);
    const auto& team = staying(run);
    const auto& index = index_of(points, team, projection);
    if constexpr (sweeping_neighborhood<N>) {
        if (auto swept = swept_graph(policy, index, team)) return *std::move(swept);
    }
    return collected_graph<notes_neighborhoods<N>, adjacency, neighbor_buffer<N>>(
        index.size(), team, [&](std::size_t i, neighbor_buffer<N>& found) {
            return find_noted(policy, index, i, found);
        });
}

}  // namespace gnomon::detail
