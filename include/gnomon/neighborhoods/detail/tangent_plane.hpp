// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane in which the neighbors of a point have an angular order: that of largest spread.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include <Eigen/Core>

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
            const Eigen::Vector3d d = points[q.index] - p;
            for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(d[a]));
        }
        exists_ = largest > 0.0 && std::isfinite(largest);
        if (!exists_) return;
        // A power of two rounds nothing, and keeps products of four coordinates in range.
        int exponent = 0;
        std::frexp(largest, &exponent);
        scale_ = std::ldexp(1.0, -std::max(exponent, -1000));
        moments m;
        for (const neighbor& q : ring) m.add(scale_ * (points[q.index] - p));
        axes_ = symmetric_eigen(m.covariance_with_point()).vectors;
    }

    /// False where all points are one place, or too far apart for numbers.
    [[nodiscard]] bool exists() const { return exists_; }

    /// The projection of point q, scaled. What is directly above or below the origin is at the
    /// origin, whatever rounding says.
    [[nodiscard]] planar_point project(const Eigen::Vector3d& q, point_index index) const {
        const Eigen::Vector3d d = scale_ * (q - origin_);
        const double x = d.dot(axes_.col(0));
        const double y = d.dot(axes_.col(1));
        constexpr double rounding = 1e-14;
        if (!(std::abs(x) + std::abs(y) > rounding * d.norm())) return {0.0, 0.0, index};
        return {x, y, index};
    }

    /// A squared distance [m^2] in the units of the projection.
    [[nodiscard]] double projected(double squared_distance) const {
        return scale_ * scale_ * squared_distance;
    }

  private:
    Eigen::Vector3d origin_;
    Eigen::Matrix3d axes_ = Eigen::Matrix3d::Identity();
    double scale_ = 1.0;
    bool exists_ = false;
};

}  // namespace gnomon::detail
