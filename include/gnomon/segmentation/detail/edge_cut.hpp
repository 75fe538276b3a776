// SPDX-License-Identifier: BSL-1.0
/// @file
/// The edge within a region: faces that meet at one are within the noise of a common plane, if they
/// are small or meet at a shallow angle, and grow into one region; but two planes explain them
/// better.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

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
/// @param reject_curved  whether a curved surface that explains them better is left whole
/// @return nothing if one plane explains them as well. O(n). (A template, so that only its users
///         compile it.)
template <class Cloud>
[[nodiscard]] std::optional<plane> edge_cut(const Cloud& cloud,
                                            std::span<const point_index> members,
                                            const planar_region& whole, std::size_t min_points,
                                            auto&& is_edge, bool reject_curved) {
    if (members.size() < 2 * min_points) return std::nullopt;
    constexpr std::size_t pieces = 8;  // numerical: of sixteen as many planes are found
    double least = whole.sums.squares(whole.fit);
    std::optional<plane> best;
    for_each_axis<pieces>(cloud, members, whole, [&](const auto& all) {
        double squares = least;
        const std::size_t cut = all.best_cut(min_points, is_edge, squares);
        if (cut == 0 || (reject_curved && all.is_curved(cut))) return;
        best = all.cut_before(cut);
        least = squares;
    });
    return best;
}

}  // namespace gnomon::detail
