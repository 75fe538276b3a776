// SPDX-License-Identifier: BSL-1.0
/// @file
/// The points of a planar segment, moved onto its plane. In no umbrella: include it by name.
///
///     const auto wall = gnomon::project_to_plane(gnomon::subset_view(scan, parts[s]), plane);
///     draw(wall[shape.polygons[0].outline[0]]);  // a corner of an alpha shape of the same points
///
/// Noise displaces a point along its ray. The ray itself is known well, so its intersection with
/// the plane is where it met the surface, whatever the error of the range. A projection along the
/// normal keeps the part of the noise that is in the plane, which at oblique incidence is most of
/// it: an outline is then too large, as its corners are the points with the largest errors.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/detail/ray_projection.hpp>

namespace gnomon {

/// Moves points along their rays to where these meet a plane. A point is moved along the normal
/// instead if its view point is not known; if its ray is within a degree of the plane; or if it is
/// farther from the plane, along the ray, than five standard deviations of all points, estimated by
/// the median.
/// @param points      any point range of n points [m]
/// @param plane       e.g. that of a segment
/// @param projection  maps an element of the range to a point
/// @return n positions [m] in the order of the points; those of points that are not finite are the
///         same as before
/// @throws std::invalid_argument  if n is 2^32 - 1 or more, the view points are for another number
///                                of points, or unless the normal is of unit length
/// Complexity: O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<Eigen::Vector3d> project_to_plane(const R& points,
                                                            const gnomon::plane& plane,
                                                            Proj projection = {}) {
    detail::require_hesse(plane);
    const position_view<R, Proj> p(points, std::move(projection));
    std::vector<Eigen::Vector3d> result;
    result.reserve(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) result.push_back(p[i]);
    detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
        detail::ray_projection(p, viewpoints, plane)
            .for_each([&](std::size_t i, const Eigen::Vector3d& x) {
                result[i] = detail::combined(1.0, x, -plane.signed_distance(x), plane.normal);
            });
    });
    return result;
}

}  // namespace gnomon
