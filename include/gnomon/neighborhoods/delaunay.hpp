// SPDX-License-Identifier: BSL-1.0
/// @file
/// The Delaunay star in the tangent plane: a point and its k nearest neighbors are projected onto
/// their plane of largest spread; the neighbors of the point in the 2D Delaunay triangulation, in
/// angular order, are its neighbors. There are about six, all around the point.
///
/// Only the star of the point is computed, no triangulation. A star whose circumcircles all lie
/// within the disc that the k nearest neighbors cover is certified: no further point of the plane
/// could enter one. Otherwise k is doubled. A star at the border of the points is open and never
/// certified, nor is a star in a plane that is determined by a single scan line or by noise.
///
/// Klasing 2010, Sec. 3.2.2, Fig. 3.1; the thesis does not state k; 20 is chosen here.
#pragma once

#include <cstddef>
#include <functional>
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

/// Models `indexed_neighborhood`; its notes state which stars are open, and which are certified.
struct delaunay {
    std::size_t k = 20;     ///< neighbors that are triangulated at first, and define the plane
    int max_doublings = 4;  ///< of k, as long as there is no certificate

    /// The stored graph of points, or of an index of them. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is under 3
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return detail::graph_of(*this, points, run, projection);
    }

    /// Replaces the content of `found` by the star of the finite point i. O(log n + k log k).
    /// @throws std::invalid_argument  if k is under 3
    template <class Allocator>
    neighborhood_note find(const spatial_index& index, std::size_t i,
                           std::vector<neighbor, Allocator>& found) const;

    /// @throws std::invalid_argument  if k is under 3
    void require_valid() const { detail::require(k >= 3, "delaunay: k must be at least 3"); }
};

template <class Allocator>
neighborhood_note delaunay::find(const spatial_index& index, std::size_t i,
                                 std::vector<neighbor, Allocator>& found) const {
    require_valid();
    // Kept between calls, so that no point costs an allocation.
    struct kept_star {
        std::vector<detail::planar_point> points;
    };
    std::vector<detail::planar_point>& star = detail::thread_value<kept_star>().points;
    const Eigen::Vector3d p = index[i];
    std::size_t wanted = k;
    knn{.k = wanted}.find(index, i, found);
    // Neighbors that all coincide with the point define no plane: more are needed.
    const auto all_seen = [&] { return found.size() < wanted; };
    detail::tangent_plane plane(index, p, found);
    int doubling = 0;
    for (; !plane.exists() && !all_seen() && doubling < max_doublings; ++doubling) {
        knn{.k = wanted *= 2}.find(index, i, found);
        plane = detail::tangent_plane(index, p, found);
    }
    if (!plane.exists()) {
        found.clear();
        return {.open = true, .certified = false};
    }
    neighborhood_note note;
    for (;; ++doubling) {
        star.clear();
        for (const neighbor& q : found) star.push_back(plane.project(index[q.index], q.index));
        note.open = detail::reduce_to_star(static_cast<point_index>(i), star);
        if (note.open) break;
        constexpr double rounding = 1.0 + 1e-9;
        note.certified =
            all_seen() || 4.0 * rounding * detail::largest_squared_circumradius(star) <=
                              plane.projected(found.back().squared_distance);
        if (note.certified || all_seen() || doubling >= max_doublings) break;
        knn{.k = wanted *= 2}.find(index, i, found);
        plane.rescale(index, found);
    }
    note.certified = note.certified && !note.open && plane.is_determined();
    found.clear();
    for (const detail::planar_point& q : star)
        found.push_back({squared_distance(p, index[q.index]), q.index});
    return note;
}

}  // namespace gnomon
