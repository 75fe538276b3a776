// SPDX-License-Identifier: BSL-1.0
/// @file
/// The projection of points to a plane.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/detail/ray_projection.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// Two axes of a plane, right-handed with its normal.
struct planar_axes {
    plane of;
    Eigen::Vector3d x;
    Eigen::Vector3d y;

    explicit planar_axes(const plane& p) : of(p), x(orthogonal(p.normal)), y(cross(p.normal, x)) {}

    /// The finite points along the axes [m], from a point near them; those with known view points
    /// are moved along their rays.
    /// @param p  the view of the points
    template <class R, class Proj>
    [[nodiscard]] std::vector<planar_point> projected(const R& points,
                                                      const position_view<R, Proj>& p,
                                                      const Eigen::Vector3d& from) const {
        std::vector<planar_point> result;
        result.reserve(p.size());
        with_table_of(points, [&](const viewpoint_table& viewpoints) {
            ray_projection(p, viewpoints, of).for_each([&](std::size_t i, const auto& q) {
                const Eigen::Vector3d d = difference(q, from);
                result.push_back({dot(d, x), dot(d, y), static_cast<point_index>(i)});
            });
        });
        return result;
    }
};

}  // namespace gnomon::detail
