// SPDX-License-Identifier: BSL-1.0
/// @file
/// The stored graph of an indexed neighborhood: what operator() of all of them does.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include <gnomon/core/detail/begins_from_sizes.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/leaf_sweep.hpp>
#include <gnomon/neighborhoods/detail/nearest_wanted.hpp>
#include <gnomon/neighborhoods/detail/place_set.hpp>
#include <gnomon/neighborhoods/detail/scratch_graph.hpp>
#include <gnomon/neighborhoods/detail/swept_graph.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// The graph of n points of which find(i, found) finds the neighbors, and returns their note. The
/// indices exist twice while it is built.
/// @tparam Notes   whether the graph stores the notes
/// @tparam Buffer  the vector that `find` takes
/// @param memory   arrays of another graph, which are reused
template <bool Notes, class Buffer = std::vector<neighbor>, execution X>
[[nodiscard]] adjacency collected_graph(std::size_t n, const X& run, auto&& find,
                                        adjacency::arrays memory = {}) {
    auto& begin = memory.begin;
    begin.assign(n + 1, 0);
    memory.notes.resize(Notes ? n : 0);
    scratch<scratch<point_index>> indices_of_chunk(chunk_count(n));
    for_each_chunk(run, n, [&](std::size_t first, std::size_t last) {
        scratch<point_index>& indices = indices_of_chunk[first / chunk_size];
        Buffer found;
        for (std::size_t i = first; i < last; ++i) {
            const neighborhood_note note = find(i, found);
            if constexpr (Notes) memory.notes[i] = note;
            begin[i + 1] = found.size();
            for (const neighbor& q : found) indices.push_back(q.index);
        }
    });
    begins_from_sizes(begin);
    auto& indices = memory.indices;
    indices.clear();
    indices.reserve(static_cast<std::size_t>(begin.back()));
    for (scratch<point_index>& chunk : indices_of_chunk) {
        indices.insert(indices.end(), chunk.begin(), chunk.end());
        scratch<point_index>().swap(chunk);
    }
    return adjacency(std::move(memory));
}

/// The graph with the k nearest neighbors of the points i for which wanted(i) holds, nearest first;
/// the other points have none. O(n / 32), and O(k log k) for each of them.
template <execution X>
[[nodiscard]] scratch_graph graph_of_some(std::size_t k, auto&& wanted, const spatial_index& index,
                                          const X& run) {
    place_set some;
    some.assign_if(index.tree(), wanted);
    scratch_graph::arrays graph;
    sweep_any_sizes(index.size(), run, graph, [&](auto&& make_visitor) {
        sweep_nearest(index.tree(), {.k = k, .of = &some}, run, make_visitor);
    });
    return scratch_graph(std::move(graph));
}

/// The graph of a neighborhood over points, or over an index of them.
/// @param memory  arrays of another graph, which are reused
template <indexed_neighborhood N, class R, execution X, class Proj>
[[nodiscard]] adjacency graph_of(const N& policy, const R& points, const X& run,
                                 const Proj& projection, adjacency::arrays memory = {}) {
    require_valid(policy);
    const auto& team = staying(run);
    const auto& index = index_of(points, team, projection);
    if constexpr (sweeping_neighborhood<N>) {
        sweep_graph(policy, index, team, memory);
        return adjacency(std::move(memory));
    } else {
        return collected_graph<notes_neighborhoods<N>, neighbor_buffer<N>>(
            index.size(), team,
            [&](std::size_t i, neighbor_buffer<N>& found) {
                return find_noted(policy, index, i, found);
            },
            std::move(memory));
    }
}

}  // namespace gnomon::detail
