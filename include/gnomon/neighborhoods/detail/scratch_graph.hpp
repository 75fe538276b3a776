// SPDX-License-Identifier: BSL-1.0
/// @file
/// A neighbor graph in scratch memory, for algorithms that need it only while they run.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/detail/memory_pool.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>

namespace gnomon::detail {

/// Models `neighborhood_graph`; as `adjacency`, without notes.
class scratch_graph {
  public:
    /// The graph in which the neighbors of point i are `indices` from begin[i] to begin[i + 1].
    scratch_graph(scratch<std::uint64_t> begin, scratch<point_index> indices)
        : begin_(std::move(begin)), indices_(std::move(indices)) {}

    [[nodiscard]] std::size_t size() const { return begin_.size() - 1; }
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        return {indices_.data() + begin_[i], indices_.data() + begin_[i + 1]};
    }

  private:
    scratch<std::uint64_t> begin_;
    scratch<point_index> indices_;
};

/// The vectors that a graph is made of.
template <class Graph>
struct vectors_of {
    using begins = std::vector<std::uint64_t>;
    using indices = std::vector<point_index>;
};
template <>
struct vectors_of<scratch_graph> {
    using begins = scratch<std::uint64_t>;
    using indices = scratch<point_index>;
};

}  // namespace gnomon::detail
