// SPDX-License-Identifier: BSL-1.0
/// @file
/// The neighbors of any neighborhood in angular order: counterclockwise around the point in its
/// tangent plane, which the averaging estimators require and k nearest neighbors do not have.
///
/// Klasing 2010, Sec. 3.2.4 assumes "some sensible order".
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/thread_team.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/tangent_plane.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

namespace detail {

/// Sorts the neighbors of point i counterclockwise in their tangent plane.
/// @param note  of the unsorted neighborhood
/// @return the note of the sorted one
inline neighborhood_note sort_angularly(const auto& points, std::size_t i,
                                        std::vector<neighbor>& found, neighborhood_note note) {
    struct kept_fan {
        std::vector<planar_point> points;
    };
    std::vector<planar_point>& fan = thread_value<kept_fan>().points;  // so that no point allocates
    note.open = true;
    const Eigen::Vector3d p = points[i];
    if (!is_finite(p)) return note;
    const tangent_plane plane(points, p, found);
    if (!plane.exists()) return note;
    note.certified = note.certified && plane.is_determined();
    fan.clear();
    for (const neighbor& q : found) fan.push_back(plane.project(points[q.index], q.index));
    // Points directly above or below the point have no direction, and come first, by index.
    const auto directed = std::partition(
        fan.begin(), fan.end(), [](const planar_point& q) { return q.x == 0.0 && q.y == 0.0; });
    std::sort(fan.begin(), directed,
              [](const planar_point& a, const planar_point& b) { return a.index < b.index; });
    const std::span<planar_point> around(directed, fan.end());
    sort_by_direction(around);
    note.open = begin_after_gap(around);
    found.clear();
    for (const planar_point& q : fan)
        found.push_back({squared_distance(p, points[q.index]), q.index});
    return note;
}

}  // namespace detail

/// Models `indexed_neighborhood`. A neighborhood is open where half of the plane or more is without
/// neighbors; it then begins after the gap. It is not certified where the plane is undetermined, as
/// along a single scan line. O(k log k) for each point in addition to the base.
template <class N = knn>
struct angularly_sorted {
    N base = {};  ///< any indexed neighborhood, e.g. angularly_sorted{knn{.k = 20}}

    /// The stored graph of points, or of an index of them.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the neighbors of the finite point i.
    neighborhood_note find(const spatial_index& index, std::size_t i,
                           std::vector<neighbor>& found) const {
        const neighborhood_note note = detail::find_noted(base, index, i, found);
        return detail::sort_angularly(index, i, found, note);
    }

    void require_valid() const { detail::require_valid(base); }
};

template <class N>
angularly_sorted(N) -> angularly_sorted<N>;

namespace detail {

/// The neighborhoods of a stored graph in angular order, as a new graph. O(k log k) for each.
/// @throws std::invalid_argument  if graph and points differ in size, or an index is out of range
template <class R, neighborhood_graph G, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] adjacency sort_angularly(const R& points, const G& graph, const X& run = {},
                                       Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    require(graph.size() == p.size(), "sort_angularly: graph and points differ in size");
    return collected_graph<true>(p.size(), run, [&](std::size_t i, std::vector<neighbor>& found) {
        found.clear();
        for (const point_index j : graph[i]) {
            require(j < p.size(), "sort_angularly: an index of the graph is out of range");
            found.push_back({0.0, j});
        }
        return sort_angularly(p, i, found, note_of(graph, i));
    });
}

}  // namespace detail
}  // namespace gnomon
