// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane in which the neighbors of a point have an angular order: that of largest spread.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

/// The two principal directions of the largest spread of a point and its neighbors. Of neighbors on
/// a line it contains the line.
class tangent_plane {
  public:
    /// @param points  a position_view
    /// @param p       one of the points
    /// @param ring    its neighbors
    tangent_plane(const auto& points, const Eigen::Vector3d& p, const std::vector<neighbor>& ring)
        : origin_(p) {
        double largest = 0.0;
        for (const neighbor& q : ring) {
            const Eigen::Vector3d d = difference(points[q.index], p);
            for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(d[a]));
        }
        exists_ = largest > 0.0 && std::isfinite(largest);
        if (!exists_) return;
        // A power of two rounds nothing, and keeps products of four coordinates in range.
        int exponent = 0;
        std::frexp(largest, &exponent);
        scale_ = std::ldexp(1.0, -std::max(exponent, -1000));
        moments m;
        for (const neighbor& q : ring) m.add(scaled(scale_, difference(points[q.index], p)));
        const Eigen::Matrix3d axes = symmetric_eigen(m.covariance_with_point()).vectors;
        x_axis_ = column(axes, 0);
        y_axis_ = column(axes, 1);
    }

    /// False where all points are one place, or too far apart for numbers.
    [[nodiscard]] bool exists() const { return exists_; }

    /// The projection of point q, scaled. What is directly above or below the origin is at the
    /// origin, whatever rounding says.
    [[nodiscard]] planar_point project(const Eigen::Vector3d& q, point_index index) const {
        const Eigen::Vector3d d = scaled(scale_, difference(q, origin_));
        const double x = dot(d, x_axis_);
        const double y = dot(d, y_axis_);
        constexpr double rounding = 1e-14;
        if (!(std::abs(x) + std::abs(y) > rounding * length(d))) return {0.0, 0.0, index};
        return {x, y, index};
    }

    /// A squared distance [m^2] in the units of the projection.
    [[nodiscard]] double projected(double squared_distance) const {
        return scale_ * scale_ * squared_distance;
    }

  private:
    Eigen::Vector3d origin_;
    Eigen::Vector3d x_axis_;
    Eigen::Vector3d y_axis_;
    double scale_ = 1.0;
    bool exists_ = false;
};

}  // namespace gnomon::detail
