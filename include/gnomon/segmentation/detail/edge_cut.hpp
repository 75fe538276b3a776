// SPDX-License-Identifier: BSL-1.0
/// @file
/// Edges within the noise. Small faces that meet at one, or at a shallow one, a crease, are within
/// the noise of a common plane, and grow into one region; but two planes explain them better.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/strips.hpp>

namespace gnomon::detail {

/// Where to cut a region in two: across one of its principal axes, at an eighth of its extent, the
/// one after which two planes that meet at an edge explain the points best.
/// @param cloud       a planar_cloud
/// @param members     of the region, all finite
/// @param min_points  the least number of each part
/// @param is_edge     is_edge(part, part): whether their planes meet at an edge
/// @param not_curved  whether a curved surface that explains them better is left whole
/// @return nothing if one plane explains them as well. O(n). (A template, so that only its users
///         compile it.)
[[nodiscard]] std::optional<plane> edge_cut(const auto& cloud, std::span<const point_index> members,
                                            const planar_region& whole, std::size_t min_points,
                                            auto&& is_edge, bool not_curved) {
    if (members.size() < 2 * min_points) return std::nullopt;
    const eigen_decomposition principal = symmetric_eigen(whole.sums.positions.covariance());
    double least = whole.sums.squares(whole.fit);
    std::optional<plane> best;
    for (int axis = 0; axis < 2; ++axis) {
        constexpr std::size_t pieces = 8;  // performance only: of sixteen as many planes are found
        const Eigen::Vector3d along = column(principal.vectors, axis);
        const auto position = [&](point_index i) { return dot(along, cloud.offsets[i]); };
        double first = position(members.front()), last = first;
        for (const point_index i : members) {
            first = std::min(first, position(i));
            last = std::max(last, position(i));
        }
        const double width = (last - first) / static_cast<double>(pieces);
        if (!(width > 0.0)) continue;
        strips<pieces> all(along, first, width);
        for (const point_index i : members) all.add(cloud, i);
        if (const auto cut = all.best_cut(min_points, is_edge, not_curved, least)) best = cut;
    }
    return best;
}

/// Where to cut the union of two regions that meet at a crease. Near it the noise is more than the
/// distance of the planes, so that it is not found by giving each point to the nearer plane, which
/// also turns the planes; but on which side of it a point lies is known. It is searched for across
/// itself, as far to either side as noise could hide it, twice.
/// @param cloud       a planar_cloud
/// @param members     of either region, all finite
/// @param regions     the two
/// @param min_points  the least number of each part
/// @return a plane with the first region on its negative side, or nothing. O(n)
[[nodiscard]] std::optional<plane> crease_cut(
    const auto& cloud, const std::array<std::span<const point_index>, 2>& members,
    const std::array<planar_region, 2>& regions, std::size_t min_points) {
    const auto& [a, b] = regions;
    constexpr angle most = degrees(30);  // numerical: at more, the planes are far apart soon
    if (!are_at_crease(a, b) || are_turned(a, b, most)) return std::nullopt;
    const Eigen::Vector3d& n = a.fit.plane.normal;
    const Eigen::Vector3d& m = b.fit.plane.normal;
    const double cosine = dot(n, m), turn = cosine < 0.0 ? -1.0 : 1.0;
    // The plane that halves the angle of both, through the crease and almost across the regions.
    const Eigen::Vector3d between = combined(1.0, n, -turn, m);
    double scale = 1.0 / length(between);
    if (scale * dot(between, difference(b.fit.centroid, a.fit.centroid)) < 0.0) scale = -scale;
    const plane middle{scaled(scale, between),
                       scale * (a.fit.plane.offset - turn * b.fit.plane.offset)};
    if (middle.signed_distance(a.fit.centroid) >= 0.0 ||
        middle.signed_distance(b.fit.centroid) <= 0.0)
        return std::nullopt;
    const double noise = std::sqrt(std::max(a.sums.noise_along(n), b.sums.noise_along(m)));
    const double sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    const double reach = 2.0 * most_deviations * noise / sine;
    if (!(reach > 0.0)) return std::nullopt;  // no noise hides the crease
    constexpr std::size_t pieces = 32;        // performance only
    strips<pieces> both(middle.normal, middle.offset - reach, 2.0 * reach / pieces);
    for (const auto& some : members)
        for (const point_index i : some) both.add(cloud, i);
    double least = std::numeric_limits<double>::infinity();
    return both.best_cut(
        min_points, [](const auto& l, const auto& r) { return are_at_crease(l, r); }, true, least);
}

}  // namespace gnomon::detail
