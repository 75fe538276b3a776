// SPDX-License-Identifier: BSL-1.0
/// @file
/// A stored neighbor graph: all rings in one array, one after the other, with their beginnings.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `annotated_graph` in 4 bytes per neighbor and 8 per point, and 2 where there are notes.
class adjacency {
  public:
    adjacency() = default;

    /// The graph whose rings are `indices` from begin[i] to begin[i + 1].
    /// @throws std::invalid_argument  unless begin ascends from 0 to the number of indices
    adjacency(std::vector<std::uint64_t> begin, std::vector<point_index> indices)
        : begin_(std::move(begin)), indices_(std::move(indices)) {
        detail::require(!begin_.empty() && begin_.front() == 0 &&
                            begin_.back() == indices_.size() &&
                            std::is_sorted(begin_.begin(), begin_.end()),
                        "adjacency: rings must lie one after the other");
    }

    /// The graph of all rings that `search` finds. Complexity: that of its n searches; while
    /// building, the indices exist twice.
    template <neighbor_search S, execution X = sequential>
    explicit adjacency(const S& search, const X& run = {}) : begin_(search.size() + 1, 0) {
        std::vector<std::vector<point_index>> rings_of_chunk(chunk_count(search.size()));
        if constexpr (annotated_search<S>) notes_.resize(search.size());
        for_each_chunk(run, search.size(), [&](std::size_t first, std::size_t last) {
            std::vector<point_index>& rings = rings_of_chunk[first / chunk_size];
            std::vector<neighbor> ring;
            for (std::size_t i = first; i < last; ++i) {
                const ring_note note = search_noted(search, i, ring);
                if (!notes_.empty()) notes_[i] = note;
                begin_[i + 1] = ring.size();
                for (const neighbor& q : ring) rings.push_back(q.index);
            }
        });
        for (std::size_t i = 1; i < begin_.size(); ++i) begin_[i] += begin_[i - 1];
        indices_.reserve(begin_.back());
        for (std::vector<point_index>& rings : rings_of_chunk) {
            indices_.insert(indices_.end(), rings.begin(), rings.end());
            std::vector<point_index>().swap(rings);
        }
    }

    /// Number of points.
    [[nodiscard]] std::size_t size() const { return begin_.empty() ? 0 : begin_.size() - 1; }

    /// The neighbors of point i, in the order in which they were found.
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        return {indices_.data() + begin_[i], indices_.data() + begin_[i + 1]};
    }

    /// What the search noted of the ring of point i.
    [[nodiscard]] ring_note note(std::size_t i) const {
        return notes_.empty() ? ring_note{} : notes_[i];
    }

    friend bool operator==(const adjacency&, const adjacency&) = default;

  private:
    std::vector<std::uint64_t> begin_{0};
    std::vector<point_index> indices_;
    std::vector<ring_note> notes_;  // empty, or one per point
};

}  // namespace gnomon
