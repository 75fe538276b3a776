// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlanePCA that turns away from outliers: points far from the plane lose their weight, the plane
/// is fitted again, and so on, with a scale that shrinks from the spread of all points to that of
/// those near the plane (iteratively reweighted least squares with Welsch weights; Holland and
/// Welsch 1977). Near an edge it settles on the surface that has more of the neighbors.
///
/// Klasing 2010, Sec. 3.2.6 names robust fits as an improvement.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// Models `estimator`. Needs two neighbors. O(iterations k). Trust as for `plane_pca`, of the
/// points with their final weights.
struct robust_pca {
    int iterations = 6;
    /// Points this many standard deviations from the plane have lost 40 % of their weight, the
    /// deviation being that of the weighted points: of a plane with mere normal noise 2.0 makes it,
    /// and with it the last value of the spectrum, 13 % too small, and keeps the points.
    double cutoff = 2.0;
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    /// @throws std::invalid_argument  unless the cutoff is positive
    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p, ring_view ring) const {
        detail::require(cutoff > 0.0, "robust_pca: the cutoff must be positive");
        plane_fit fit = plane_pca{min_aspect_ratio}(p, ring);
        if (!usable(fit.trust)) return fit;
        Eigen::Vector3d center = moments_about(p, ring).mean_with_point();
        for (int i = 0; i < iterations; ++i) {
            const double variance = fit.spectrum.lambda[2];
            if (variance <= 1e-24 * fit.spectrum.lambda[0]) break;  // a plane already
            const double precision = 0.5 / (cutoff * cutoff * variance);
            weighted_moments m;
            const auto add = [&](const Eigen::Vector3d& d) {
                const double r = detail::dot(fit.normal, detail::difference(d, center));
                m.add(d, std::exp(-precision * r * r));
            };
            add({0.0, 0.0, 0.0});
            for (const Eigen::Vector3d& q : ring) add(detail::difference(q, p));
            const plane_fit next = detail::plane_of_least_spread(m.covariance(), min_aspect_ratio);
            if (!usable(next.trust)) break;
            fit = next;
            center = m.mean();
        }
        return fit;
    }
};

}  // namespace gnomon
