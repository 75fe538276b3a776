// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlaneEKF line by line as in the thesis, for comparison: the state is a 3-vector of any length,
/// the initial state is random, and every further pass counts the same measurements again. From
/// some initial states it does not converge, and its covariance is far too small: use `plane_ekf`.
///
/// Klasing 2010, Sec. 3.2.7, Alg. 3.2, Eqs. (3.16)-(3.18).
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/range_of_plane.hpp>
#include <gnomon/normals/detail/require_noise.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>

namespace gnomon {

/// Models `ray_estimator`. Needs two neighbors. O(passes k). The covariance is that of the
/// algorithm, of the state x, transformed to the unit normal x / |x|.
struct literal_plane_ekf {
    static constexpr auto sensitive_to =
        sensitivity::order | sensitivity::units | sensitivity::axes;

    noise_curve noise = constant_noise{};  ///< of the sensor
    int passes = 5;                        ///< over all points
    double prior_variance = 10.0;          ///< Sigma_0 = 10 I
    std::uint64_t seed = 1;                ///< of the random initial state x_0

    /// @throws std::invalid_argument  if the noise is 0, unless the prior variance is
    ///                                positive and finite and there is a pass
    [[nodiscard]] normal_belief<> operator()(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                             const Eigen::Vector3d& viewpoint = {0.0, 0.0,
                                                                                 0.0}) const {
        detail::require_noise(noise);
        detail::require(passes >= 1 && prior_variance > 0.0 && std::isfinite(prior_variance),
                        "literal_plane_ekf: needs a pass and a positive prior variance");
        if (neighbors.size() < 2) return {};
        return belief_of(filtered(p, neighbors, viewpoint));
    }

  private:
    struct gaussian_state {
        Eigen::Vector3d x;
        Eigen::Matrix3d covariance;
    };

    /// Alg. 3.2, line by line.
    [[nodiscard]] gaussian_state filtered(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                          const Eigen::Vector3d& viewpoint) const {
        using namespace detail;  // dot, scaled, ...
        random_stream random(seed);
        Eigen::Vector3d x;  // line 1
        for (int a = 0; a < 3; ++a) x[a] = random.gaussian();
        x = scaled(1.0 / length(x), x);
        Eigen::Matrix3d covariance = diagonal(prior_variance, prior_variance, prior_variance);
        const moments m = moments::about(p, neighbors);
        const Eigen::Vector3d seen = difference(p, viewpoint);
        const Eigen::Vector3d centroid = combined(1.0, seen, 1.0, m.mean_with_point());  // line 2
        const auto update = [&](const Eigen::Vector3d& q) {
            const double range = length(q);
            const Eigen::Vector3d u = scaled(1.0 / range, q);                 // line 4
            const double h = range_of_plane(centroid, x, u);                  // line 5
            const Eigen::Vector3d jacobian = range_gradient(centroid, x, u);  // line 6
            const Eigen::Vector3d ph = product(covariance, jacobian);
            const double variance = noise.variance_along(q);
            const double gain = 1.0 / (dot(jacobian, ph) + variance);  // line 7: K = gain ph
            x = combined(1.0, x, (range - h) * gain, ph);              // line 8
            add_outer(covariance, -gain, ph, ph);                      // line 9
        };
        for (int pass = 0; pass < passes; ++pass) {
            update(seen);
            for (const Eigen::Vector3d& q : neighbors) update(difference(q, viewpoint));
        }
        return {x, covariance};
    }

    /// The unit normal of a state, with its covariance.
    static normal_belief<> belief_of(const gaussian_state& state) {
        normal_belief<> belief;
        const double size = detail::length(state.x);
        const bool finite = std::isfinite(size) && detail::all_finite(state.covariance);
        belief.trust = finite ? trust::degenerate : trust::not_finite;
        if (!finite || size == 0.0) return belief;
        belief.normal = detail::direction_of(state.x);
        belief.trust = trust::good;
        const detail::tangent_basis frame(belief.normal);
        const auto [p11, p12, p22] = frame.restricted(state.covariance);
        const double w = 1.0 / (size * size);
        detail::set_covariance(belief, frame, {w * p11, w * p12, w * p22});
        return belief;
    }
};

}  // namespace gnomon
