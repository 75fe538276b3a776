// SPDX-License-Identifier: BSL-1.0
/// @file
/// The extended information filter: `ray_ls` with the covariance of its normal. The inverse range
/// is linear in m = n/d, so that all measurements add up to one linear system without iteration.
///
/// Klasing 2010, Sec. 3.2.7 names the extended information filter as an extension that "avoids
/// iterative computations".
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>
#include <gnomon/normals/detail/require_noise.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/ray_ls.hpp>

namespace gnomon {

namespace detail {

/// The normal of a regression, with its covariance.
/// @param ray    from the view point to the point [m]
/// @param sigma  of the noise along the rays [m]
[[nodiscard]] inline normal_belief<ray_fit> belief_of(const ray_regression& regression,
                                                      const Eigen::Vector3d& ray, double sigma,
                                                      double min_aspect_ratio) {
    normal_belief<ray_fit> belief;
    static_cast<ray_fit&>(belief) = plane_seen(regression, min_aspect_ratio);
    if (!usable(belief.trust)) return belief;
    // n = M / |M|: only the part of the error of M across n rotates n.
    const tangent_basis frame(belief.normal);
    const double scaled_sigma = sigma / length(regression.solution());
    set_covariance(belief, frame,
                   {regression.covariance(scaled_sigma, frame.b1, frame.b1),
                    regression.covariance(scaled_sigma, frame.b1, frame.b2),
                    regression.covariance(scaled_sigma, frame.b2, frame.b2)},
                   ray);
    return belief;
}

}  // namespace detail

/// Models `ray_estimator`. Needs three neighbors. O(k), hardly longer than `ray_ls`. Normal and
/// trust are those of `ray_ls`; `weak` as well where the trace of the covariance is above
/// 0.09 rad^2, or would be for a plane whose slope across the ray is 3 standard deviations less.
struct plane_eif {
    noise_curve noise = constant_noise{};  ///< of the sensor
    ray_ls fit = {};                       ///< the regression

    /// @throws std::invalid_argument  if the noise is 0
    [[nodiscard]] normal_belief<ray_fit> operator()(const Eigen::Vector3d& p,
                                                    neighborhood_view neighbors,
                                                    const Eigen::Vector3d& viewpoint = {
                                                        0.0, 0.0, 0.0}) const {
        detail::require_noise(noise);
        if (neighbors.size() < 3) return {};
        const Eigen::Vector3d ray = detail::difference(p, viewpoint);
        return detail::belief_of(detail::regression_of(p, neighbors, viewpoint), ray,
                                 noise.along(ray), fit.min_aspect_ratio);
    }
};

}  // namespace gnomon
