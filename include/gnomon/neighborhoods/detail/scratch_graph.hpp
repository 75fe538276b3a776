// SPDX-License-Identifier: BSL-1.0
/// @file
/// A neighbor graph in scratch memory, for algorithms that need it only while they run.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>

namespace gnomon::detail {

/// Models `neighborhood_graph`; as `adjacency`, without notes.
class scratch_graph {
  public:
    /// What it consists of.
    struct arrays {
        scratch<std::uint64_t> begin;  // of the neighbors of each point, and their end
        scratch<point_index> indices;  // the neighbors of all points
    };

    explicit scratch_graph(arrays all) : arrays_(std::move(all)) {}

    [[nodiscard]] std::size_t size() const { return arrays_.begin.size() - 1; }
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        return {arrays_.indices.data() + arrays_.begin[i],
                arrays_.indices.data() + arrays_.begin[i + 1]};
    }

  private:
    arrays arrays_;
};

/// The first neighbors of each point in a graph, at most k. Models `neighborhood_graph`; refers to
/// the graph.
template <class Graph>
class first_neighbors {
  public:
    first_neighbors(const Graph& graph, std::size_t k) : graph_(graph), k_(k) {}

    [[nodiscard]] std::size_t size() const { return graph_.size(); }
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        const auto all = graph_[i];
        return all.first(std::min(k_, all.size()));
    }

  private:
    const Graph& graph_;
    std::size_t k_;
};

}  // namespace gnomon::detail
