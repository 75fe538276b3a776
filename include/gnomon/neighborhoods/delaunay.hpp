// SPDX-License-Identifier: BSL-1.0
/// @file
/// Delaunay neighbors: a point and its k nearest neighbors are projected onto their tangent plane
/// and triangulated there; the neighbors in the triangulation, in angular order, are the ring. Few
/// neighbors (about six), all around the point, and none behind another.
///
/// Only the star of the point is made, never a triangulation. A star whose circles all lie within
/// the disc that the k nearest neighbors cover is certified: no further point of the plane could
/// enter one. Else k is doubled. A star at the border of the points is open, and nothing certifies
/// it, nor a star in a plane that a single scan line or noise has chosen.
///
/// Klasing 2010, Sec. 3.2.2, Fig. 3.1; k = 20 is ours, the thesis does not tell.
#pragma once

#include <cstddef>
#include <functional>
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
#include <gnomon/neighborhoods/detail/tree_search.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon {

/// Models `streaming_neighborhood`; its notes say which stars are open, and which are certified.
struct delaunay {
    std::size_t k = 20;     ///< neighbors that are triangulated at first, and define the plane
    int max_doublings = 4;  ///< of k, as long as there is no certificate

    /// The stored graph. O(n (log n + k log k)).
    /// @throws std::invalid_argument  if k is under 3
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] adjacency operator()(const R& points, const X& run = {},
                                       Proj projection = {}) const {
        return adjacency(search(points, std::move(projection)), run);
    }

    /// A search that stores nothing but its index; the points must outlive it.
    /// @throws std::invalid_argument  if k is under 3
    template <class R, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] auto search(const R& points, Proj projection = {}) const {
        detail::require(k >= 3, "delaunay: k must be at least 3");
        return detail::tree_search(*this, points, std::move(projection));
    }

    template <class R, class Proj = std::identity>
    void search(const R&& points, Proj projection = {}) const = delete;

    /// The ring of the finite point i.
    ring_note find(const kd_tree& tree, const auto& points, std::size_t i,
                   std::vector<neighbor>& ring) const;
};

ring_note delaunay::find(const kd_tree& tree, const auto& points, std::size_t i,
                         std::vector<neighbor>& ring) const {
    // Kept between calls, so that no point costs an allocation.
    static thread_local std::vector<detail::planar_point> star;
    const Eigen::Vector3d p = points[i];
    std::size_t wanted = k;
    tree.nearest(p, wanted, i, ring);
    // Of neighbors that all coincide with the point there is no plane: look farther.
    const auto all_seen = [&] { return ring.size() < wanted; };
    detail::tangent_plane plane(points, p, ring);
    int doubling = 0;
    for (; !plane.exists() && !all_seen() && doubling < max_doublings; ++doubling) {
        tree.nearest(p, wanted *= 2, i, ring);
        plane = detail::tangent_plane(points, p, ring);
    }
    if (!plane.exists()) {
        ring.clear();
        return {.open = true, .certified = false};
    }
    ring_note note;
    for (;; ++doubling) {
        star.clear();
        for (const neighbor& q : ring) star.push_back(plane.project(points[q.index], q.index));
        note.open = detail::reduce_to_star(static_cast<point_index>(i), star);
        if (note.open) break;
        constexpr double rounding = 1.0 + 1e-9;
        note.certified =
            all_seen() || 4.0 * rounding * detail::largest_squared_circumradius(star) <=
                              plane.projected(ring.back().squared_distance);
        if (note.certified || all_seen() || doubling >= max_doublings) break;
        tree.nearest(p, wanted *= 2, i, ring);
        plane.rescale(points, ring);
    }
    note.certified = note.certified && !note.open && plane.is_determined();
    ring.clear();
    for (const detail::planar_point& q : star)
        ring.push_back({squared_distance(p, points[q.index]), q.index});
    return note;
}

}  // namespace gnomon
