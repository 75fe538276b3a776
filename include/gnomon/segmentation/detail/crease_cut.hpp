// SPDX-License-Identifier: BSL-1.0
/// @file
/// The border between two regions whose planes meet at a crease, a shallow edge. Near the crease
/// the planes are closer to each other than the noise: a border that gives each point to the nearer
/// plane is anywhere in the noise, and the planes of such regions are turned. On which side of a
/// crease a point lies hardly depends on its noise, so that the border is searched for among the
/// parallels of the line in which the planes meet.
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
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_edges.hpp>
#include <gnomon/segmentation/detail/strips.hpp>
#include <gnomon/segmentation/detail/surface_noise.hpp>

namespace gnomon::detail {

/// Two regions, cut again at a border.
/// @return the parts on its negative and on its positive side. O(n)
template <class Cloud>
[[nodiscard]] std::array<planar_region, 2> parts_at(const plane& border, const Cloud& cloud,
                                                    std::span<const point_index> first,
                                                    std::span<const point_index> second) {
    std::array<planar_region, 2> parts;
    for (const auto& members : {first, second})
        for (const point_index i : members)
            cloud.add(i, parts[border.signed_distance(cloud.offsets[i]) > 0.0 ? 1 : 0].sums);
    for (planar_region& part : parts) part.fit = part.sums.fit();
    return parts;
}

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
    const auto middle = middle_of(a, b);
    if (!middle) return std::nullopt;
    const Eigen::Vector3d& n = a.fit.plane.normal;
    const Eigen::Vector3d& m = b.fit.plane.normal;
    const double noise = std::sqrt(std::max(a.sums.noise_along(n), b.sums.noise_along(m)));
    const double sine = length(cross(n, m));
    // Twice as far as noise hides the distance of the planes, as these are turned.
    const double reach = 2.0 * most_deviations * noise / sine;
    if (!(reach > 0.0)) return std::nullopt;
    constexpr std::size_t pieces = 32;  // numerical: a sixteenth of the reach
    strips<Cloud, pieces> both(cloud, middle->normal, middle->offset - reach, 2.0 * reach / pieces);
    for (const std::size_t r : {first, second}) both.add(members[r]);
    double least = std::numeric_limits<double>::infinity();
    const std::size_t cut = both.best_cut(
        min_points, [](const auto& l, const auto& r) { return are_at_crease(l, r); }, least);
    if (cut == 0 || both.is_curved(cut)) return std::nullopt;
    // The line in which the planes of both sides meet is more precise than the best cut. The border
    // is there if that is stable: cut there and fit again, they meet there again. Else there is a
    // step between them, too.
    const plane border = both.cut_before(cut);
    const auto cut_at = [&](const plane& at) {
        return parts_at(at, cloud, members[first], members[second]);
    };
    plane at = border;
    std::array<planar_region, 2> parts = cut_at(at);
    std::size_t before = 0;  // points of the first part
    for (int pass = 0; pass < 2; ++pass) {
        const auto meeting = middle_of(parts[0], parts[1]);
        if (!meeting) return border;
        at = *meeting;
        before = parts[0].sums.count;
        parts = cut_at(at);
    }
    if (!are_at_crease(parts[0], parts[1]) ||
        std::min(parts[0].sums.summands, parts[1].sums.summands) < min_points)
        return border;
    const auto [fewer, more] = std::minmax(before, parts[0].sums.count);
    const bool is_stable =
        part_on_wrong_side * (more - fewer) <= std::min(parts[0].sums.count, parts[1].sums.count);
    return is_stable ? at : border;
}

}  // namespace gnomon::detail
