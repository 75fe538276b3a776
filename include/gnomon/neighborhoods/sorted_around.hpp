// SPDX-License-Identifier: BSL-1.0
/// @file
/// Any neighborhood's rings in angular order: counterclockwise around the point in its tangent
/// plane, which the averaging estimators want and k nearest neighbors do not have.
///
/// Klasing 2010, Sec. 3.2.4 assumes "some sensible order".
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>
#include <gnomon/neighborhoods/detail/tangent_plane.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

namespace detail {

/// Models `annotated_search`: another search's rings, sorted.
template <class Search, class R, class Proj>
class sorted_search {
  public:
    sorted_search(Search search, const R& points, Proj projection)
        : search_(std::move(search)), points_(points, std::move(projection)) {}

    [[nodiscard]] std::size_t size() const { return search_.size(); }

    ring_note operator()(std::size_t i, std::vector<neighbor>& ring) const {
        static thread_local std::vector<planar_point> fan;  // no point costs an allocation
        ring_note note = search_noted(search_, i, ring);
        note.open = true;
        const Eigen::Vector3d p = points_[i];
        if (!is_finite(p)) return note;
        const tangent_plane plane(points_, p, ring);
        if (!plane.exists()) return note;
        note.certified = note.certified && plane.is_determined();
        fan.clear();
        for (const neighbor& q : ring) fan.push_back(plane.project(points_[q.index], q.index));
        // What is directly above or below the point has no direction, and comes first, by index.
        const auto directed = std::partition(
            fan.begin(), fan.end(), [](const planar_point& q) { return q.x == 0.0 && q.y == 0.0; });
        std::sort(fan.begin(), directed,
                  [](const planar_point& a, const planar_point& b) { return a.index < b.index; });
        const std::span<planar_point> around(directed, fan.end());
        sort_by_direction(around);
        note.open = begin_after_gap(around);
        ring.clear();
        for (const planar_point& q : fan)
            ring.push_back({squared_distance(p, points_[q.index]), q.index});
        return note;
    }

  private:
    Search search_;
    position_view<R, Proj> points_;
};

/// Models `annotated_search`: reads a stored graph.
template <neighborhood_graph G>
class graph_search {
  public:
    explicit graph_search(const G& graph) : graph_(&graph) {}

    [[nodiscard]] std::size_t size() const { return graph_->size(); }

    ring_note operator()(std::size_t i, std::vector<neighbor>& ring) const {
        ring.clear();
        for (const point_index j : (*graph_)[i]) {
            require(j < size(), "sort_around: the graph lists a neighbor of no point");
            ring.push_back({0.0, j});
        }
        return note_of(*graph_, i);
    }

  private:
    const G* graph_;
};

}  // namespace detail

/// Models `streaming_neighborhood`. A ring is open where half of the plane or more is without
/// neighbors; it then begins after the gap. It is not certified where the plane is not, as along a
/// single scan line. O(k log k) per ring beside those of the base.
template <class N = knn>
struct sorted_around {
    N base = {};  ///< any streaming neighborhood, e.g. sorted_around{knn{.k = 20}}

    /// The stored graph.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires streaming_neighborhood<N, R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return adjacency(search(points, std::move(projection)), run);
    }

    /// A search that stores nothing but its index; the points must outlive it.
    template <class R, class Proj = std::identity>
        requires streaming_neighborhood<N, R, Proj>
    [[nodiscard]] auto search(const R& points, Proj projection = {}) const {
        return detail::sorted_search(base.search(points, projection), points, projection);
    }

    template <class R, class Proj = std::identity>
    void search(const R&& points, Proj projection = {}) const = delete;
};

template <class N>
sorted_around(N) -> sorted_around<N>;

/// The rings of a stored graph in angular order, as a new graph. O(k log k) per ring.
/// @throws std::invalid_argument  if graph and points differ in size, or an index is of no point
template <class R, neighborhood_graph G, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] adjacency sort_around(const R& points, const G& graph, const X& run = {},
                                    Proj projection = {}) {
    detail::require(graph.size() == static_cast<std::size_t>(std::ranges::size(points)),
                    "sort_around: the graph is of other points");
    return adjacency(detail::sorted_search(detail::graph_search(graph), points, projection), run);
}

}  // namespace gnomon
