// SPDX-License-Identifier: BSL-1.0
/// @file
/// A segment as merging sees it: how flat it is, what it tells of its plane, and where gaps to
/// others begin.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/occlusion/detail/plane_comparison.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>

namespace gnomon::detail {

/// Where three points in four of a segment are in one plane, no thicker than twice the noise, the
/// segment is flat, and gaps begin there: the others may be round a corner, or what something in
/// front has lent it.
struct fragment {
    scratch<point_index> members;
    scratch<point_index> on_plane;  ///< of a flat one: of these, if three in four, else all
    principal_frame frame;
    plane_sample plane;
    /// Of its plane, or else the sum of those of its points; of any length.
    Eigen::Vector3d normal{0.0, 0.0, 0.0};
    bool is_flat = false;
    bool is_known = false;  ///< tells the direction of its plane by itself
    bool is_spot = false;   ///< narrower than noise
    bool is_new = true;     ///< since the round before
};

/// The sum of the normals of some points.
[[nodiscard]] Eigen::Vector3d sum_of_normals(const auto& normals,
                                             std::span<const point_index> members) {
    Eigen::Vector3d sum(0.0, 0.0, 0.0);
    for (const point_index i : members) {
        const Eigen::Vector3d normal = normals[i].normal;
        if (is_finite(normal)) sum = combined(1.0, sum, 1.0, normal);
    }
    return sum;
}

/// The fragment of some points of a position_view. O(n).
/// @param normals        of all points, towards their view points
/// @param members        the points of the segment
/// @param positions      memory for the positions of the members
/// @param max_variation  surface variation of a flat segment
/// @param max_angle      by which planes may differ: the direction of a plane is known if its
///                       uncertainty is smaller
/// @param sigma          the standard deviation of ranges [m]
template <class Points>
[[nodiscard]] fragment fragment_of(const Points& points, const auto& normals,
                                   const viewpoint_table& viewpoints, scratch<point_index> members,
                                   std::span<Eigen::Vector3d> positions, double max_variation,
                                   angle max_angle, double sigma) {
    fragment f;
    f.members = std::move(members);
    std::transform(f.members.begin(), f.members.end(), positions.begin(),
                   [&points](point_index i) { return points[i]; });
    const moments_about_first all(positions);
    f.frame = principal_axes_of(all);
    f.plane = plane_sample_of(positions, all, mean_viewpoint(f.members, viewpoints), sigma);
    const auto are_most = [&](std::size_t count) { return 4 * count >= 3 * f.members.size(); };
    const double thickness2 = symmetric_eigen(f.plane.covariance).values[2];
    f.is_flat =
        f.plane.count > 0 && (f.frame.spectrum.surface_variation() <= max_variation ||
                              (are_most(f.plane.count) && thickness2 <= 4.0 * sigma * sigma));
    if (f.is_flat) f.on_plane = points_on_plane(positions, f.members, f.plane, sigma);
    if (f.is_flat && !are_most(f.on_plane.size())) f.on_plane = f.members;
    const plane_knowledge known = knowledge_of(f.plane, sigma);
    f.is_known = known.uncertainty <= max_angle;
    f.normal = f.is_known ? known.normal : sum_of_normals(normals, f.members);
    f.is_spot = known.squared_width < sigma * sigma;
    return f;
}

/// What the planes of two tell of each other.
[[nodiscard]] inline plane_comparison comparison_of(const fragment& a, const fragment& b,
                                                    double sigma) {
    const bool first = a.frame.spectrum.lambda[1] >= b.frame.spectrum.lambda[1];
    return {(first ? a : b).plane, (first ? b : a).plane, sigma};
}

/// Whether two segments without anything in front of their gap may be parts of one surface. A
/// segment hardly wider than the noise determines its plane poorly; its mean normal must then agree
/// with that of the other within 45 degrees. The normals of a segment narrower than the noise are
/// noise, so that the plane of the other must be known.
[[nodiscard]] inline bool may_adjoin(const fragment& a, const fragment& b) {
    if (a.is_spot || b.is_spot) return a.is_known || b.is_known;
    constexpr double blended = 0.5;  // the square of the cosine of 45 degrees
    const double product = dot(a.normal, b.normal);
    return product >= 0.0 &&
           product * product >= blended * dot(a.normal, a.normal) * dot(b.normal, b.normal);
}

}  // namespace gnomon::detail
