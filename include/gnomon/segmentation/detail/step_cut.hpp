// SPDX-License-Identifier: BSL-1.0
/// @file
/// The step within a region: parallel surfaces side by side, as the fronts of two houses, are
/// within the noise of a common plane if one is hardly higher than the other, and grow into one
/// region.
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

/// Where to cut a region in two: across one of its principal axes, where two planes with a step
/// between them explain the points best. The place is searched for among sixteenths of the extent
/// of the region, then among sixteenths of the two on both sides of the best place. Only there it
/// is known whether there is a step, as a few points from its other side turn a plane.
/// @param cloud       a planar_cloud
/// @param members     of the region, all finite
/// @param min_points  the least number of each part
/// @return nothing if one plane explains them as well, or a curved surface better. O(n). (A
///         template, so that only its users compile it.)
template <class Cloud>
[[nodiscard]] std::optional<plane> step_cut(const Cloud& cloud,
                                            std::span<const point_index> members,
                                            const planar_region& whole, std::size_t min_points) {
    if (members.size() < 2 * min_points) return std::nullopt;
    constexpr std::size_t pieces = 16;  // numerical: of eighths, a step at a third is not found
    double least = whole.sums.squares(whole.fit);
    std::optional<plane> best;
    for_each_axis<pieces>(cloud, members, whole, [&](const auto& wide) {
        double squares = least;
        const std::size_t about = wide.best_cut(
            min_points, [](const auto&, const auto&) { return true; }, squares);
        if (about == 0 || wide.is_curved(about)) return;
        const auto narrow = wide.finer(about, members);
        squares = least;
        const std::size_t cut = narrow.best_cut(
            min_points, [](const auto& a, const auto& b) { return are_at_step(a, b); }, squares);
        if (cut == 0) return;
        best = narrow.cut_before(cut);
        least = squares;
    });
    return best;
}

}  // namespace gnomon::detail
