// SPDX-License-Identifier: BSL-1.0
/// @file
/// The step within a region: parallel surfaces side by side, as the fronts of two houses, are
/// within the noise of a common plane if one is hardly higher than the other, and grow into one
/// region.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
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
    constexpr std::size_t pieces = 16;  // numerical: of eighths, a step at a third is not found
    if (members.size() < 2 * min_points) return std::nullopt;
    const eigen_decomposition principal = symmetric_eigen(whole.sums.positions.covariance());
    double least = whole.sums.squares(whole.fit);
    std::optional<plane> best;
    for (int axis = 0; axis < 2; ++axis) {
        const Eigen::Vector3d along = column(principal.vectors, axis);
        const auto [first, last] = extent_along(cloud, members, along);
        const double width = (last - first) / static_cast<double>(pieces);
        if (!(width > 0.0)) continue;
        const strips<Cloud, pieces> wide(cloud, along, first, width, members);
        double squares = least;
        const std::size_t about = wide.best_cut(
            min_points, [](const auto&, const auto&) { return true; }, squares);
        if (about == 0 || wide.is_curved(about)) continue;
        const double finer = 2.0 * width / static_cast<double>(pieces);
        const strips<Cloud, pieces> narrow(cloud, along, wide.position(about) - width, finer,
                                           members);
        squares = least;
        const std::size_t cut = narrow.best_cut(
            min_points, [](const auto& a, const auto& b) { return are_at_step(a, b); }, squares);
        if (cut == 0) continue;
        best = plane{along, narrow.position(cut)};
        least = squares;
    }
    return best;
}

}  // namespace gnomon::detail
