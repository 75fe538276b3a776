// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighborhoods for the loops over all points: the same from a graph that stores them and from a
/// search that finds one at a time, and the positions of their members.
#pragma once

#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon::detail {

/// The neighbors of a point as a graph or a search returns them (a view, or a reference), with
/// their note.
template <class Neighbors>
struct noted_neighborhood {
    Neighbors members;
    neighborhood_note note = {};
};

/// The neighborhoods that a graph stores, and their notes. Needs no buffer.
template <neighborhood_graph G>
class stored_neighborhoods {
  public:
    struct buffer {};

    explicit stored_neighborhoods(const G& graph) : graph_(graph) {}

    [[nodiscard]] auto operator()(std::size_t i, buffer&) const {
        return noted_neighborhood<decltype(graph_[i])>{graph_[i], note_of(graph_, i)};
    }

  private:
    const G& graph_;
};

/// The neighborhoods that a policy finds one at a time, in a buffer, and their notes.
template <indexed_neighborhood N>
class found_neighborhoods {
  public:
    using buffer = neighbor_buffer<N>;

    found_neighborhoods(const N& policy, const spatial_index& index)
        : policy_(policy), index_(index) {}

    [[nodiscard]] auto operator()(std::size_t i, buffer& found) const {
        const neighborhood_note note = find_noted(policy_, index_, i, found);
        return noted_neighborhood<const buffer&>{found, note};
    }

  private:
    const N& policy_;
    const spatial_index& index_;
};

/// The buffer of `stored_neighborhoods` or `found_neighborhoods`.
template <class Neighborhoods>
using buffer_of = typename std::remove_cvref_t<Neighborhoods>::buffer;

[[nodiscard]] inline point_index index_in(point_index i) { return i; }
[[nodiscard]] inline point_index index_in(const neighbor& q) { return q.index; }

/// Looks up the positions of neighbors, through one buffer.
template <class Points>
class neighbor_gatherer {
  public:
    /// @param complaint  the message if an index is out of range: "estimate_normals: ..."
    neighbor_gatherer(const Points& points, const char* complaint)
        : points_(points), complaint_(complaint) {}

    /// The positions of the neighbors, until the next call.
    /// @throws std::invalid_argument  with the complaint, if an index is out of range
    template <class Neighbors>
    [[nodiscard]] neighborhood_view operator()(const noted_neighborhood<Neighbors>& neighbors) {
        positions_.clear();
        for (const auto& q : neighbors.members) {
            const std::size_t i = index_in(q);
            require(i < points_.size(), complaint_);
            positions_.push_back(points_[i]);
        }
        return {positions_, neighbors.note.open};
    }

  private:
    const Points& points_;
    const char* complaint_;
    scratch<Eigen::Vector3d> positions_;
};

}  // namespace gnomon::detail
