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
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

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
        if (nearest.size() == count && !(candidate < nearest.back())) continue;
        if (!is_finite(points[i])) continue;
        if (nearest.size() < count) nearest.emplace_back();
        auto slot = nearest.end() - 1;
        for (; slot != nearest.begin() && candidate < slot[-1]; --slot) *slot = slot[-1];
        *slot = candidate;
    }
    return nearest;
}

/// For each of some points, the one of others that is nearest; of finite ones only. In one pass
/// over these, as they may be many. Precondition: there is a finite one.
template <class Points>
[[nodiscard]] scratch<neighbor> nearest_to_each(const Points& points,
                                                std::span<const neighbor> some,
                                                std::span<const point_index> others) {
    scratch<Eigen::Vector3d> places;
    for (const neighbor& p : some) places.push_back(points[p.index]);
    constexpr neighbor none{std::numeric_limits<double>::infinity(),
                            std::numeric_limits<point_index>::max()};
    scratch<neighbor> nearest(some.size(), none);
    for (const point_index i : others) {
        const Eigen::Vector3d other = points[i];
        for (std::size_t k = 0; k < places.size(); ++k) {
            const neighbor candidate{squared_distance(other, places[k]), i};
            if (candidate < nearest[k] && is_finite(other)) nearest[k] = candidate;
        }
    }
    return nearest;
}

/// Appends the boundary pairs of two segments to `found`; see boundary_pairs.
template <class Points>
void append_boundary_pairs(auto& found, const Points& points, std::span<const point_index> first,
                           std::span<const point_index> second,
                           const std::pair<Eigen::Vector3d, Eigen::Vector3d>& centroids,
                           std::size_t pairs) {
    const auto near_second = nearest_of(points, first, centroids.second, pairs / 2);
    const auto near_first = nearest_of(points, second, centroids.first, pairs / 2);
    if (near_second.empty() || near_first.empty()) return;
    const auto across = nearest_to_each(points, near_second, second);
    for (std::size_t k = 0; k < across.size(); ++k)
        found.push_back(
            {near_second[k].index, across[k].index, std::sqrt(across[k].squared_distance)});
    const auto back = nearest_to_each(points, near_first, first);
    for (std::size_t k = 0; k < back.size(); ++k)
        found.push_back({back[k].index, near_first[k].index, std::sqrt(back[k].squared_distance)});
}

/// The boundary pairs of two segments of some points: half of them from each side.
///
/// @param points     a position_view of the cloud
/// @param first      indices of the points of one segment
/// @param second     of the other
/// @param centroids  of both
/// @param pairs      n_b, as many as are wanted, an even number; fewer if a segment has fewer
///                   finite points
/// @throws std::invalid_argument  for an index out of range
/// Complexity: O(pairs * (|first| + |second|)).
template <class Points>
[[nodiscard]] std::vector<boundary_pair> boundary_pairs(
    const Points& points, std::span<const point_index> first, std::span<const point_index> second,
    const std::pair<Eigen::Vector3d, Eigen::Vector3d>& centroids, std::size_t pairs = 6) {
    std::vector<boundary_pair> found;
    append_boundary_pairs(found, points, first, second, centroids, pairs);
    return found;
}

/// rho_c, the least distance of the pairs [m], Eq. (4.7); infinite if there are none.
[[nodiscard]] inline double coplanar_distance(std::span<const boundary_pair> pairs) {
    double least = std::numeric_limits<double>::infinity();
    for (const boundary_pair& p : pairs) least = std::min(least, p.distance);
    return least;
}

}  // namespace gnomon::detail
