// SPDX-License-Identifier: BSL-1.0
/// @file
/// The edge within a region: small faces that meet at one are within the noise of a common plane,
/// and grow into one region, but two planes explain them better.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>

namespace gnomon::detail {

/// Where to cut a region in two: across one of its principal axes, at an eighth of its extent, the
/// one after which two planes that meet at an edge explain the points best.
/// @param cloud       a planar_cloud
/// @param members     of the region, all finite
/// @param min_points  the least number of each part
/// @return nothing if one plane explains them as well. O(n). (A template, so that only its users
///         compile it.)
[[nodiscard]] std::optional<plane> edge_cut(const auto& cloud, std::span<const point_index> members,
                                            const planar_region& whole, std::size_t min_points) {
    if (members.size() < 2 * min_points) return std::nullopt;
    const eigen_decomposition principal = symmetric_eigen(whole.sums.positions.covariance());
    const auto cost = [](const planar_region& r) {
        return static_cast<double>(r.sums.count) * r.fit.chi2;
    };
    double least = cost(whole);
    std::optional<plane> best;
    for (int axis = 0; axis < 2; ++axis) {
        constexpr std::size_t pieces = 8;  // chosen: of sixteen as many planes are found
        const Eigen::Vector3d along = column(principal.vectors, axis);
        const auto position = [&](point_index i) { return dot(along, cloud.offsets[i]); };
        double first = position(members.front()), last = first;
        for (const point_index i : members) {
            first = std::min(first, position(i));
            last = std::max(last, position(i));
        }
        const double width = (last - first) / static_cast<double>(pieces);
        if (!(width > 0.0)) continue;
        std::array<plane_sums, pieces> sums;
        for (const point_index i : members) {
            const auto piece = static_cast<std::size_t>((position(i) - first) / width);
            cloud.add(i, sums[std::min(piece, pieces - 1)]);
        }
        for (std::size_t cut = 1; cut < pieces; ++cut) {
            planar_region a, b;
            for (std::size_t p = 0; p < pieces; ++p) (p < cut ? a : b).sums.add(sums[p]);
            if (std::min(a.sums.summands, b.sums.summands) < min_points) continue;
            a.fit = a.sums.fit();
            b.fit = b.sums.fit();
            if (!are_at_edge(a, b) || !(cost(a) + cost(b) < least)) continue;
            least = cost(a) + cost(b);
            best = plane{along, first + width * static_cast<double>(cut)};
        }
    }
    return best;
}

}  // namespace gnomon::detail
