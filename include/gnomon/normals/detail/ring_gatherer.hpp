// SPDX-License-Identifier: BSL-1.0
/// @file
/// Rings for the loops over all points: the same from a graph that stores them and from a search
/// that finds one at a time, and the positions of their members.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon::detail {

/// A ring as a graph or a search gives it (a view, or a reference), with what is known of it.
template <class Ring>
struct noted_ring {
    Ring members;
    ring_note note = {};
};

/// rings(i, buffer) gives the noted ring of point i in the graph, and leaves the buffer alone.
template <neighborhood_graph G>
[[nodiscard]] auto stored_rings(const G& graph) {
    return [&graph](std::size_t i, std::vector<neighbor>&) {
        return noted_ring<decltype(graph[i])>{graph[i], note_of(graph, i)};
    };
}

/// rings(i, buffer) searches the ring of point i into the buffer, and gives it with its note.
template <neighbor_search S>
[[nodiscard]] auto found_rings(const S& search) {
    return [&search](std::size_t i, std::vector<neighbor>& buffer) {
        const ring_note note = search_noted(search, i, buffer);
        return noted_ring<const std::vector<neighbor>&>{buffer, note};
    };
}

[[nodiscard]] inline point_index index_in(point_index i) { return i; }
[[nodiscard]] inline point_index index_in(const neighbor& q) { return q.index; }

/// Looks up the members of rings in a position_view, ring by ring, through one buffer.
template <class Points>
class ring_gatherer {
  public:
    /// @param complaint  about an index of no point: "estimate_normals: the graph lists ..."
    ring_gatherer(const Points& points, const char* complaint)
        : points_(points), complaint_(complaint) {}

    /// The positions of the ring's members, until the next call.
    /// @throws std::invalid_argument  with the complaint, if an index is of no point
    template <class Ring>
    [[nodiscard]] ring_view operator()(const noted_ring<Ring>& ring) {
        positions_.clear();
        for (const auto& q : ring.members) {
            const std::size_t i = index_in(q);
            require(i < points_.size(), complaint_);
            positions_.push_back(points_[i]);
        }
        return {positions_, ring.note.open};
    }

  private:
    const Points& points_;
    const char* complaint_;
    std::vector<Eigen::Vector3d> positions_;
};

}  // namespace gnomon::detail
