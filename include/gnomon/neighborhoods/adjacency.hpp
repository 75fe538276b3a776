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
    /// What it consists of.
    struct arrays {
        std::vector<std::uint64_t> begin;      ///< of the neighbors of each point, and their end
        std::vector<point_index> indices;      ///< the neighbors of all points
        std::vector<neighborhood_note> notes;  ///< empty, or one per point

        friend bool operator==(const arrays&, const arrays&) = default;
    };

    adjacency() = default;

    /// The graph in which the neighbors of point i are `indices` from begin[i] to begin[i + 1].
    /// @param notes  of each point; none if empty
    /// @throws std::invalid_argument  unless begin ascends from 0 to the number of indices and
    ///                                there are as many notes as points, or none
    adjacency(std::vector<std::uint64_t> begin, std::vector<point_index> indices,
              std::vector<neighborhood_note> notes = {})
        : adjacency(arrays{std::move(begin), std::move(indices), std::move(notes)}) {}

    /// The same graph from its arrays.
    /// @throws std::invalid_argument  as above
    explicit adjacency(arrays all) : arrays_(std::move(all)) {
        const auto& [begin, indices, notes] = arrays_;
        detail::require(!begin.empty() && begin.front() == 0 && begin.back() == indices.size() &&
                            std::is_sorted(begin.begin(), begin.end()),
                        "adjacency: neighborhoods must lie one after the other");
        detail::require(notes.empty() || notes.size() == size(),
                        "adjacency: the number of notes is not that of points");
    }

    /// Number of points.
    [[nodiscard]] std::size_t size() const {
        return arrays_.begin.empty() ? 0 : arrays_.begin.size() - 1;
    }

    /// The neighbors of point i, in the order of the policy. Precondition: i < size().
    [[nodiscard]] std::span<const point_index> operator[](std::size_t i) const {
        return {arrays_.indices.data() + arrays_.begin[i],
                arrays_.indices.data() + arrays_.begin[i + 1]};
    }

    /// What the search noted of the neighborhood of point i. Precondition: i < size().
    [[nodiscard]] neighborhood_note note(std::size_t i) const {
        return arrays_.notes.empty() ? neighborhood_note{} : arrays_.notes[i];
    }

    /// Its arrays, for another graph in their memory; this one has no points then.
    [[nodiscard]] arrays release() { return std::exchange(arrays_, {{0}, {}, {}}); }

    friend bool operator==(const adjacency&, const adjacency&) = default;

  private:
    arrays arrays_{{0}, {}, {}};
};

}  // namespace gnomon
