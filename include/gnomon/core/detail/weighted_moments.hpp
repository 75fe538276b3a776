// SPDX-License-Identifier: BSL-1.0
/// @file
/// Weighted sums over a neighborhood about its query point, from which the weighted mean and
/// covariance follow.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>

namespace gnomon::detail {

/// Sum of weights, weighted sum and weighted sum of outer products of offsets d_j [m] from a point.
struct weighted_moments {
    double weight = 0.0;                 ///< sum of w_j
    Eigen::Vector3d sum{0.0, 0.0, 0.0};  ///< sum of w_j d_j [m]
    Eigen::Matrix3d outer =
        diagonal(0.0, 0.0, 0.0);  ///< sum of w_j d_j d_j^T [m^2]; lower triangle only

    /// Adds the neighbor at `offset` [m] from the point with weight `w`.
    void add(const Eigen::Vector3d& offset, double w) {
        weight += w;
        add_moments(sum, outer, offset, w);
    }

    /// The weighted mean of the offsets [m]. Precondition: weight > 0.
    [[nodiscard]] Eigen::Vector3d mean() const { return scaled(1.0 / weight, sum); }

    /// The weighted covariance [m^2]. Precondition: weight > 0.
    [[nodiscard]] Eigen::Matrix3d covariance() const {
        return covariance_of(sum, outer, 1.0 / weight);
    }

    /// The weighted mean of d_j d_j^T [m^2]: second moments about the point, not about the mean.
    /// Precondition: weight > 0.
    [[nodiscard]] Eigen::Matrix3d second_moments() const {
        return scaled_whole(outer, 1.0 / weight);
    }
};

}  // namespace gnomon::detail
