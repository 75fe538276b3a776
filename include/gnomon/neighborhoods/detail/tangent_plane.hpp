// SPDX-License-Identifier: BSL-1.0
/// @file
/// The plane in which the neighbors of a point have an angular order: that of largest spread.
#pragma once

#include <algorithm>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// The two principal directions of the largest spread of a point and its neighbors. Of neighbors on
/// a line it contains the line.
class tangent_plane {
  public:
    /// @param points     a position_view
    /// @param p          one of the points
    /// @param neighbors  its neighbors
    tangent_plane(const auto& points, const Eigen::Vector3d& p, std::span<const neighbor> neighbors)
        : origin_(p) {
        rescale(points, neighbors);
        if (!exists_) return;
        moments m;
        for (const neighbor& q : neighbors) m.add(scaled(scale_, difference(points[q.index], p)));
        const eigen_decomposition e = symmetric_eigen(m.covariance_with_point());
        x_axis_ = column(e.vectors, 0);
        y_axis_ = column(e.vectors, 1);
        // Not along a scan line, nor where noise is as wide as the neighborhood.
        determined_ = e.values[1] > 0.01 * e.values[0] && e.values[1] > 2.0 * e.values[2];
    }

    /// Keeps the plane, but scales projections for other neighbors, by a power of two, which is
    /// exact, so that products of four coordinates stay in range.
    void rescale(const auto& points, std::span<const neighbor> neighbors) {
        double largest = 0.0;
        for (const neighbor& q : neighbors) {
            const Eigen::Vector3d d = difference(points[q.index], origin_);
            for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(d[a]));
        }
        exists_ = largest > 0.0 && std::isfinite(largest);
        if (!exists_) return;
        scale_ = power_to_one(largest);
    }

    /// False where all points coincide, or where their distances overflow.
    [[nodiscard]] bool exists() const { return exists_; }

    /// Whether the neighbors spread in two directions, each more than across.
    [[nodiscard]] bool is_determined() const { return determined_; }

    /// The projection of point q, scaled. Points directly above or below the origin are projected
    /// to the origin exactly, in spite of rounding.
    [[nodiscard]] planar_point project(const Eigen::Vector3d& q, point_index index) const {
        const Eigen::Vector3d d = scaled(scale_, difference(q, origin_));
        const double x = dot(d, x_axis_);
        const double y = dot(d, y_axis_);
        constexpr double rounding = 1e-14;
        constexpr double smallest = 1e-60;  // products of four do not underflow
        if (!(std::abs(x) + std::abs(y) > std::max(rounding * length(d), smallest)))
            return {0.0, 0.0, index};
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
    bool determined_ = false;
};

}  // namespace gnomon::detail
