// SPDX-License-Identifier: BSL-1.0
/// @file
/// The border between two regions whose planes meet at a crease, a shallow edge. Near the crease
/// the planes are closer to each other than the noise: a border that gives each point to the nearer
/// plane is anywhere in the noise, and the planes of such regions are turned. On which side of a
/// crease a point lies hardly depends on its noise, so that the border is searched for among the
/// parallels of the line in which the planes meet.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/strips.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// Where to cut the union of two regions that meet at a crease.
/// @param cloud       a planar_cloud
/// @param members     of all regions, all finite: label_groups
/// @param regions     their planar_region
/// @param first       one of two
/// @param second      the other
/// @param min_points  the least number of each part
/// @return a plane with the first region on its negative side; nothing if they do not meet at a
///         crease, or a curved surface explains them better. O(n)
template <class Cloud>
[[nodiscard]] std::optional<plane> crease_cut(const Cloud& cloud, const auto& members,
                                              const auto& regions, std::size_t first,
                                              std::size_t second, std::size_t min_points) {
    const auto &a = regions[first], &b = regions[second];
    if (!are_at_crease(a, b) || are_turned(a, b, widest_crease)) return std::nullopt;
    const Eigen::Vector3d& n = a.fit.plane.normal;
    const Eigen::Vector3d& m = b.fit.plane.normal;
    const double cosine = dot(n, m), turn = cosine < 0.0 ? -1.0 : 1.0;
    // The plane through the crease that halves the angle of both: almost perpendicular to them.
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
    // Twice as far as noise hides the distance of the planes, as these are turned.
    const double reach = 2.0 * most_deviations * noise / sine;
    if (!(reach > 0.0)) return std::nullopt;
    constexpr std::size_t pieces = 32;  // numerical: a sixteenth of the reach
    strips<Cloud, pieces> both(cloud, middle.normal, middle.offset - reach, 2.0 * reach / pieces);
    for (const std::size_t r : {first, second}) both.add(members[r]);
    double least = std::numeric_limits<double>::infinity();
    const std::size_t cut = both.best_cut(
        min_points, [](const auto& l, const auto& r) { return are_at_crease(l, r); }, least);
    if (cut == 0 || both.is_curved(cut)) return std::nullopt;
    return both.cut_before(cut);
}

}  // namespace gnomon::detail
