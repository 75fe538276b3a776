// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlanePCA with Gaussian weights of the distance, which reduce the bias on curved surfaces.
///
/// Klasing 2010, Sec. 3.2.6 suggests weighted covariances as an improvement; Alexa et al. 2003.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `estimator`. Needs two neighbors. O(k). Trust as for `plane_pca`.
struct weighted_pca {
    /// The standard deviation of the Gaussian weight, as a multiple of the largest distance of a
    /// neighbor.
    double bandwidth = 0.5;
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    /// @throws std::invalid_argument  unless the bandwidth is positive
    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        detail::require(bandwidth > 0.0, "weighted_pca: the bandwidth must be positive");
        if (neighbors.size() < 2) return {};
        double farthest2 = 0.0;
        for (const Eigen::Vector3d& q : neighbors)
            farthest2 = std::max(farthest2, squared_distance(p, q));
        const double half_precision = -0.5 / (bandwidth * bandwidth * farthest2);
        detail::weighted_moments m;
        m.add({0.0, 0.0, 0.0}, 1.0);
        for (const Eigen::Vector3d& q : neighbors) {
            const Eigen::Vector3d d = detail::difference(q, p);
            m.add(d, farthest2 > 0.0 ? std::exp(half_precision * detail::dot(d, d)) : 1.0);
        }
        return detail::plane_of_least_spread(m.covariance(), min_aspect_ratio);
    }
};

}  // namespace gnomon
