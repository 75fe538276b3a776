// SPDX-License-Identifier: BSL-1.0
/// @file
/// A stored neighbor graph: the neighbors of all points in one array, one point after the other,
/// with the beginning of each.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `annotated_graph` in 4 bytes per neighbor and 8 per point, and 2 where there are notes.
class adjacency {
  public:
    adjacency() = default;

    /// The graph in which the neighbors of point i are `indices` from begin[i] to begin[i + 1].
    /// @param notes  of each point; none if empty
    /// @throws std::invalid_argument  unless begin ascends from 0 to the number of indices and
    ///                                there are as many notes as points, or none
    adjacency(std::vector<std::uint64_t> begin, std::vector<point_index> indices,
              std::vector<neighborhood_note> notes = {})
        : begin_(std::move(begin)), indices_(std::move(indices)), notes_(std::move(notes)) {
        detail::require(!begin_.empty() && begin_.front() == 0 &&
                            begin_.back() == indices_.size() &&
                            std::is_sorted(begin_.begin(), begin_.end()),
                        "adjacency: neighborhoods must lie one after the other");
        detail::require(notes_.empty() || notes_.size() == size(),
                        "adjacency: the number of notes is not that of points");
    }

    /// Number of points.
    [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }

    /// The neighbors of point i, in the order in which they were found.
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        return {indices_.data() + begin_[i], indices_.data() + begin_[i + 1]};
    }

    /// What the search noted of the neighborhood of point i.
    [[nodiscard]] neighborhood_note note(std::size_t i) const {
        return notes_.empty() ? neighborhood_note{} : notes_[i];
    }

    friend bool operator==(const adjacency&, const adjacency&) = default;

  private:
    std::vector<std::uint64_t> begin_{0};
    std::vector<point_index> indices_;
    std::vector<neighborhood_note> notes_;  // empty, or one per point
};

}  // namespace gnomon
