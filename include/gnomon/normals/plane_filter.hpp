// SPDX-License-Identifier: BSL-1.0
/// @file
/// Kalman filters for normals: `plane_ekf` and `plane_ukf`. The measurements are the ranges of a
/// point and its neighbors, the state is their common plane, which does not move. The result is a
/// normal with its covariance, for a sensor of known noise.
///
/// The state has three degrees of freedom: a unit vector, and the distance of the plane from the
/// centroid of the neighborhood. Neither the length of the normal nor the error of the centroid
/// distorts the covariance, as they do in the thesis's filter (`literal_plane_ekf`). The initial
/// state is PlanePCA with a wide prior. Each measurement counts once: the update is iterated, each
/// time from the prior and linearized about the latest state (Gauss-Newton for the extended filter:
/// Bell and Cathey 1993; posterior linearization for the unscented one: Garcia-Fernandez et al.
/// 2015).
///
/// Klasing 2010, Sec. 3.2.7, Eqs. (3.14)-(3.18), which names the unscented filter as an extension.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/range_linearization.hpp>
#include <gnomon/normals/detail/require_noise.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

namespace detail {

/// The filter behind `plane_ekf` and `plane_ukf`.
template <range_linearization Linearization>
struct plane_filter {
    static constexpr auto sensitive_to = sensitivity::units;

    noise_curve noise = constant_noise{};  ///< of the sensor
    int max_iterations = 10;               ///< of the update; it usually takes three or four
    double prior_angle = 1.5;     ///< standard deviation of the prior normal [rad]: uninformative
    double prior_distance = 1.0;  ///< standard deviation of the prior distance [m]: uninformative

    /// @throws std::invalid_argument  if the noise is 0, unless the prior's deviations are
    ///                                positive and finite, and there is an iteration
    [[nodiscard]] normal_belief<plane_fit> operator()(const Eigen::Vector3d& p,
                                                      neighborhood_view neighbors,
                                                      const Eigen::Vector3d& viewpoint = {
                                                          0.0, 0.0, 0.0}) const {
        require_parameters();
        normal_belief<plane_fit> belief;
        if (neighbors.size() < 3) return belief;
        const moments m = moments::about(p, neighbors);
        static_cast<plane_fit&>(belief) = plane_pca{}(m);
        if (!usable(belief.trust)) return belief;
        if (!is_finite(viewpoint)) return without_normal(belief, trust::not_finite);

        // All coordinates are relative to the view point.
        const Eigen::Vector3d x = difference(p, viewpoint);
        const Eigen::Vector3d anchor = combined(1.0, x, 1.0, m.mean_with_point());
        const plane_state prior{tangent_basis(belief.normal)};
        plane_state state = prior;
        // The first linearization has no covariance: sigma points this close to each other give
        // the derivative.
        state.covariance = diagonal(1e-8, 1e-8, 1e-4 * noise.variance_along(x));
        constexpr double last_step = 1e-9;  // [rad], of rounding; numerical
        double step = 1.0;
        for (int i = 0; i < max_iterations && step > last_step; ++i) {
            information sum = information_of(prior, state);
            const Linearization linearize(state, anchor);
            add_measurement(state, linearize, x, sum);
            for (const Eigen::Vector3d& q : neighbors)
                add_measurement(state, linearize, difference(q, viewpoint), sum);
            const Eigen::Matrix3d covariance = inverse_of_symmetric(sum.precision);
            const Eigen::Vector3d delta = product(covariance, sum.weighted);
            if (!all_finite(delta) || !all_finite(covariance))
                return without_normal(belief, trust::degenerate);
            state = state.moved(delta);
            state.covariance = covariance;
            step = std::abs(delta[0]) + std::abs(delta[1]);
        }
        const Eigen::Matrix3d& c = state.covariance;
        belief.normal = state.frame.normal;
        // A last step of a hundredth of a standard deviation does not matter (numerical).
        constexpr double negligible = 0.01;
        const bool converged =
            step <= std::max(last_step, negligible * std::sqrt(c(0, 0) + c(1, 1)));
        if (!converged) belief.trust = trust::weak;
        set_covariance(belief, state.frame, {c(0, 0), c(0, 1), c(1, 1)}, x);
        return belief;
    }

  private:
    /// The information form of the difference from a state: its precision matrix, and the product
    /// of precision and mean. Information adds up without the cancellation of subtracted variances.
    struct information {
        Eigen::Matrix3d precision;
        Eigen::Vector3d weighted;
    };

    void require_parameters() const {
        require_noise(noise);
        require(max_iterations >= 1, "plane_ekf, plane_ukf: needs an iteration");
        require(prior_angle > 0.0 && std::isfinite(prior_angle) && prior_distance > 0.0 &&
                    std::isfinite(prior_distance),
                "plane_ekf, plane_ukf: the prior's deviations must be positive and finite");
    }

    /// The information of the prior about the difference from the state.
    [[nodiscard]] information information_of(const plane_state& prior,
                                             const plane_state& state) const {
        Eigen::Vector3d towards_prior = state.frame.towards(prior.frame.normal);
        towards_prior[2] = prior.distance - state.distance;
        information sum;
        sum.precision =
            diagonal(1.0 / (prior_angle * prior_angle), 1.0 / (prior_angle * prior_angle),
                     1.0 / (prior_distance * prior_distance));
        sum.weighted = product(sum.precision, towards_prior);
        return sum;
    }

    /// Adds the information of the range of one measured point, x from the view point.
    void add_measurement(const plane_state& state, const Linearization& linearize,
                         const Eigen::Vector3d& x, information& sum) const {
        const double range = length(x);
        const Eigen::Vector3d u = scaled(1.0 / range, x);
        if (!(std::abs(dot(u, state.frame.normal)) > grazing_cosine)) return;
        const linear_range z = linearize(u);
        const double precision = 1.0 / (z.variance + noise.variance_along(x));
        if (!std::isfinite(precision * (z.value + z.slope[0] + z.slope[1] + z.slope[2]))) return;
        add_outer(sum.precision, precision, z.slope, z.slope);
        sum.weighted = combined(1.0, sum.weighted, precision * (range - z.value), z.slope);
    }

    static normal_belief<plane_fit> without_normal(normal_belief<plane_fit> belief, trust why) {
        belief.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
        belief.trust = why;
        return belief;
    }
};

}  // namespace detail

/// The iterated extended Kalman filter. Models `ray_estimator`. Needs three neighbors. O(k), some
/// ten times as long as `plane_pca`.
///
/// Parameters: the `noise` of the sensor; `max_iterations`; the standard deviations `prior_angle`
/// [rad] and `prior_distance` [m] of an uninformative prior.
///
/// Trust: that of `plane_pca`; `weak` as well where the iteration does not converge, or where the
/// trace of the covariance is above 0.09 rad^2, or would be for a plane whose slope across the ray
/// is 3 standard deviations less; if all rays are grazing, the covariance is that of the prior.
/// `not_finite` where the view point is not finite.
using plane_ekf = detail::plane_filter<detail::by_derivative>;

/// The iterated unscented Kalman filter, for strong noise and grazing rays; otherwise as
/// `plane_ekf`.
using plane_ukf = detail::plane_filter<detail::by_sigma_points>;

}  // namespace gnomon
