// SPDX-License-Identifier: BSL-1.0
/// @file
/// Partly hidden views for training: points of a scan are removed as if a straight edge in front of
/// the object hid them. What remains is perceived again, so that parts are cut as behind a real
/// occluder.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/random.hpp>

namespace gnomon::recognition {

/// How much is hidden: a share drawn uniformly.
struct hide_part_options {
    double least = 0.1, most = 0.7;  ///< of the points, in [0, 1]
};

/// The points that remain visible behind an edge of random direction; the half-space behind the
/// edge and the view point hides the others.
/// @param points     any point range of n points [m]; NaN are hidden
/// @param viewpoint  of the sensor [m]
/// @return indices, ascending
/// @throws std::invalid_argument  unless 0 <= least <= most <= 1
/// Complexity: O(n log n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> hide_part(const R& points, const Eigen::Vector3d& viewpoint,
                                                 random_stream& random,
                                                 const hide_part_options& options = {},
                                                 Proj projection = {}) {
    namespace d = gnomon::detail;
    d::require(options.least >= 0.0 && options.least <= options.most && options.most <= 1.0,
               "hide_part: shares must be in [0, 1], the least before the most");
    const position_view<R, Proj> position(points, std::move(projection));
    const double share = random.uniform(options.least, options.most);
    const double turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    Eigen::Vector3d axis(0.0, 0.0, 0.0);  // towards the middle of the directions
    std::vector<std::pair<double, point_index>> across;
    for (std::size_t i = 0; i < position.size(); ++i) {
        const Eigen::Vector3d way = d::difference(position[i], viewpoint);
        if (!d::all_finite(way) || !d::has_length(way)) continue;
        axis = d::combined(1.0, axis, 1.0, d::direction_of(way));
        across.emplace_back(0.0, static_cast<point_index>(i));
    }
    if (!d::has_length(axis)) return {};
    axis = d::direction_of(axis);
    const Eigen::Vector3d other =
        std::abs(axis[2]) < 0.9 ? Eigen::Vector3d(0.0, 0.0, 1.0) : Eigen::Vector3d(1.0, 0.0, 0.0);
    const Eigen::Vector3d left = d::direction_of(d::cross(other, axis)), up = d::cross(axis, left);
    const Eigen::Vector3d edge = d::combined(std::cos(turn), left, std::sin(turn), up);
    // Of half-spaces through the view point, about the axis that is parallel to the edge.
    const auto angle_of = [&](const Eigen::Vector3d& way) {
        return std::atan2(d::dot(edge, way), d::dot(axis, way));
    };
    for (auto& [place, i] : across) place = angle_of(d::difference(position[i], viewpoint));
    std::sort(across.begin(), across.end());
    const auto n = static_cast<double>(across.size());
    across.resize(static_cast<std::size_t>(std::ceil((1.0 - share) * n)));
    std::vector<point_index> visible;
    for (const auto& [place, i] : across) visible.push_back(i);
    std::sort(visible.begin(), visible.end());
    return visible;
}

}  // namespace gnomon::recognition
