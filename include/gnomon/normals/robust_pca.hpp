// SPDX-License-Identifier: BSL-1.0
/// @file
/// Robust PlanePCA: iteratively reweighted least squares with Welsch weights (Holland and Welsch
/// 1977). The scale of the weights is the standard deviation of the weighted points across the
/// plane, so that it decreases as outliers lose their weight. Near an edge it converges to the
/// surface with more of the neighbors.
///
/// Klasing 2010, Sec. 3.2.6 suggests robust fits as an improvement.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// Models `estimator`. Needs two neighbors. O(iterations k). Trust as for `plane_pca`, of the
/// weighted points.
struct robust_pca {
    int iterations = 6;  ///< of the fit
    /// The distance from the plane at which the weight is exp(-1/2), in standard deviations of the
    /// weighted points across the plane. On a plane with normally distributed noise, 2.0 keeps the
    /// points and underestimates the smallest standard deviation of the spectrum by 13 %.
    double cutoff = 2.0;
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    /// @throws std::invalid_argument  unless the cutoff is positive
    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        detail::require(cutoff > 0.0, "robust_pca: the cutoff must be positive");
        plane_fit fit = plane_pca{min_aspect_ratio}(p, neighbors);
        if (!usable(fit.trust)) return fit;
        Eigen::Vector3d center = moments::about(p, neighbors).mean_with_point();
        for (int i = 0; i < iterations; ++i) {
            const double variance = fit.spectrum.lambda[2];
            if (variance <= 1e-24 * fit.spectrum.lambda[0]) break;  // no residuals
            const double precision = 0.5 / (cutoff * cutoff * variance);
            detail::weighted_moments m;
            const auto add = [&](const Eigen::Vector3d& d) {
                const double r = detail::dot(fit.normal, detail::difference(d, center));
                m.add(d, std::exp(-precision * r * r));
            };
            add({0.0, 0.0, 0.0});
            for (const Eigen::Vector3d& q : neighbors) add(detail::difference(q, p));
            const plane_fit next = detail::plane_of_least_spread(m.covariance(), min_aspect_ratio);
            if (!usable(next.trust)) break;
            fit = next;
            center = m.mean();
        }
        return fit;
    }
};

}  // namespace gnomon
