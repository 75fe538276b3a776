// SPDX-License-Identifier: BSL-1.0
/// @file
/// The information form of the filter: `ray_ls` with the covariance of its normal. As the inverse
/// range is linear in m = n/d, all measurements add up to one system, and nothing is iterated.
///
/// Klasing 2010, Sec. 3.2.7 names the extended information filter as an extension that "avoids
/// iterative computations".
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/ray_ls.hpp>

namespace gnomon {

/// Models `ray_estimator`. Needs three neighbors. O(k), hardly longer than `ray_ls`, whose normal
/// and trust it gives, but `weak` where the covariance exceeds some 20 degrees.
struct plane_eif {
    double sigma = 0.015;  ///< standard deviation of the range [m]
    ray_ls fit = {};

    /// @throws std::invalid_argument  unless sigma is positive and finite
    [[nodiscard]] with_covariance_of<ray_fit> operator()(const Eigen::Vector3d& p, ring_view ring,
                                                         const Eigen::Vector3d& viewpoint = {
                                                             0.0, 0.0, 0.0}) const {
        detail::require_sigma(sigma);
        with_covariance_of<ray_fit> belief;
        if (ring.size() < 3) return belief;
        const detail::ray_regression regression = detail::regression_of(p, ring, viewpoint);
        static_cast<ray_fit&>(belief) = detail::plane_seen(regression, fit.min_aspect_ratio);
        if (!usable(belief.trust)) return belief;
        // n = M / |M|: only the part of M's error across n turns n.
        const detail::tangent_basis frame(belief.normal);
        const auto& [n, b1, b2] = frame;
        const double scaled_sigma = sigma / detail::length(regression.solution());
        belief.covariance = frame.in_space(regression.covariance(scaled_sigma, b1, b1),
                                           regression.covariance(scaled_sigma, b1, b2),
                                           regression.covariance(scaled_sigma, b2, b2));
        detail::distrust_if_vague(belief);
        return belief;
    }
};

}  // namespace gnomon
