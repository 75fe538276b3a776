// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where two segments face each other: the points of each that are nearest to the other's centroid,
/// each with the nearest point of the other. Needs no hull or mesh.
///
/// Klasing 2010, Sec. 4.3.4, Fig. 4.7, and the coplanar distance, Eq. (4.7).
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// A point of one segment and one of another, by their numbers in the cloud.
struct boundary_pair {
    point_index first, second;
    double distance;  ///< [m]
};

/// The `count` of some points that are nearest to a place, nearest first; of finite ones only.
template <class Points>
[[nodiscard]] scratch<neighbor> nearest_of(const Points& points, std::span<const point_index> some,
                                           const Eigen::Vector3d& place, std::size_t count) {
    scratch<neighbor> nearest;
    if (count == 0) return nearest;
    for (const point_index i : some) {
        require(i < points.size(), "boundary_pairs: an index is out of range");
        const neighbor candidate{squared_distance(points[i], place), i};
        const bool is_full = nearest.size() == count;
        if ((is_full && !(candidate < nearest.back())) || !is_finite(points[i])) continue;
        if (is_full) nearest.pop_back();
        nearest.insert(std::upper_bound(nearest.begin(), nearest.end(), candidate), candidate);
    }
    return nearest;
}

/// Appends the boundary pairs of two segments of some points to `found`: half of them from each
/// side.
///
/// @param found      a container of `boundary_pair`
/// @param points     a position_view of the cloud
/// @param first      indices of the points of one segment
/// @param second     of the other
/// @param centroids  of both
/// @param pairs      n_b, as many as are wanted, an even number; fewer if a segment has fewer
///                   finite points
/// @throws std::invalid_argument  for an index out of range
/// Complexity: O(pairs * (|first| + |second|)).
template <class Points>
void append_boundary_pairs(auto& found, const Points& points, std::span<const point_index> first,
                           std::span<const point_index> second,
                           const std::pair<Eigen::Vector3d, Eigen::Vector3d>& centroids,
                           std::size_t pairs = 6) {
    for (const neighbor& p : nearest_of(points, first, centroids.second, pairs / 2))
        for (const neighbor& q : nearest_of(points, second, points[p.index], 1))
            found.push_back({p.index, q.index, std::sqrt(q.squared_distance)});
    for (const neighbor& q : nearest_of(points, second, centroids.first, pairs / 2))
        for (const neighbor& p : nearest_of(points, first, points[q.index], 1))
            found.push_back({p.index, q.index, std::sqrt(p.squared_distance)});
}

/// rho_c, the least distance of the pairs [m], Eq. (4.7); infinite if there are none.
[[nodiscard]] inline double coplanar_distance(std::span<const boundary_pair> pairs) {
    double least = std::numeric_limits<double>::infinity();
    for (const boundary_pair& p : pairs) least = std::min(least, p.distance);
    return least;
}

}  // namespace gnomon::detail
