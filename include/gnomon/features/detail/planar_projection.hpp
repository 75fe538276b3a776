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
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// Two axes of a plane, right-handed with its normal.
struct planar_axes {
    Eigen::Vector3d x;
    Eigen::Vector3d y;

    explicit planar_axes(const plane& p) : x(orthogonal(p.normal)), y(cross(p.normal, x)) {}

    /// The finite points along the axes [m], from a point near them.
    /// @param p  a position_view, or anything with size() and positions by index
    template <class Points>
    [[nodiscard]] std::vector<planar_point> projected(const Points& p,
                                                      const Eigen::Vector3d& from) const {
        std::vector<planar_point> result;
        result.reserve(p.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
            const Eigen::Vector3d q = p[i];
            if (!is_finite(q)) continue;
            const Eigen::Vector3d d = difference(q, from);
            result.push_back({dot(d, x), dot(d, y), static_cast<point_index>(i)});
        }
        return result;
    }
};

}  // namespace gnomon::detail
