// SPDX-License-Identifier: BSL-1.0
/// @file
/// Kalman filters for normals: `plane_ekf` and `plane_ukf`. The neighbors are measurements of
/// range of a plane that does not move; what comes out is a normal with its
/// covariance, for a known standard deviation of the range.
///
/// The state is a unit vector and the plane's distance from the neighborhood's centroid, three
/// degrees of freedom, so that neither the length of the normal nor the error of the centroid
/// distorts the covariance, as they do in the thesis's recipe (`literal_plane_ekf`). It starts with
/// PlanePCA and a prior that says nothing. A measurement counts once: to gain accuracy the update
/// is iterated, each time from the prior and about the better state (Gauss and Newton's method for
/// the extended filter: Bell and Cathey 1993; posterior linearization for the unscented one:
/// Garcia-Fernandez et al. 2015).
///
/// Klasing 2010, Sec. 3.2.7, Eqs. (3.14)-(3.18), which names the unscented filter as an extension.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/range_of_plane.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// A plane near an anchor point, with the covariance of its three degrees of freedom: turns towards
/// the two tangents [rad] and the distance along the normal [m].
struct plane_state {
    detail::tangent_basis frame{Eigen::Vector3d(0.0, 0.0, 1.0)};
    double distance = 0.0;  ///< of the plane from the anchor [m]
    Eigen::Matrix3d covariance = detail::diagonal(0.0, 0.0, 0.0);

    /// The state at `delta` from this one, without a covariance.
    [[nodiscard]] plane_state moved(const Eigen::Vector3d& delta) const {
        return {detail::tangent_basis(frame.moved(delta[0], delta[1]), frame), distance + delta[2]};
    }

    /// The range [m] at which the unit ray u from the view point meets the plane, Eq. (3.17).
    [[nodiscard]] double range(const Eigen::Vector3d& anchor, const Eigen::Vector3d& u) const {
        return detail::range_of_plane(anchor, frame.normal, u, distance);
    }
};

/// A measurement made linear about a state: value + slope . delta + an error of this variance.
struct linear_range {
    double value;           ///< [m]
    Eigen::Vector3d slope;  ///< [m/rad], [m/rad], 1
    double variance = 0.0;  ///< of what is not linear [m^2]
};

/// Made of a state and the anchor point of its plane, it linearizes the range along unit rays.
template <class L>
concept range_linearization =
    std::constructible_from<L, const plane_state&, const Eigen::Vector3d&> &&
    requires(const L& linearize, const Eigen::Vector3d& u) {
        { linearize(u) } -> std::same_as<linear_range>;
    };

/// Linearizes by the derivative, Eq. (3.18).
class by_derivative {
  public:
    by_derivative(const plane_state& state, const Eigen::Vector3d& anchor)
        : state_(state), anchor_(anchor) {}

    /// The range along the unit ray u.
    [[nodiscard]] linear_range operator()(const Eigen::Vector3d& u) const {
        const auto& [n, b1, b2] = state_.frame;
        const Eigen::Vector3d gradient = detail::range_gradient(anchor_, n, u, state_.distance);
        return {state_.range(anchor_, u),
                {detail::dot(gradient, b1), detail::dot(gradient, b2), 1.0 / detail::dot(u, n)}};
    }

  private:
    const plane_state& state_;
    const Eigen::Vector3d& anchor_;
};

/// Linearizes by regression over six points spread as the state is: the unscented transform (Julier
/// and Uhlmann 1997, kappa = 0). What the line misses among them is counted as noise.
class by_sigma_points {
  public:
    by_sigma_points(const plane_state& state, const Eigen::Vector3d& anchor)
        : anchor_(anchor), spread_(symmetric_eigen(state.covariance)) {
        for (int j = 0; j < 3; ++j) {
            const Eigen::Vector3d axis = detail::column(spread_.vectors, j);
            const auto at = static_cast<std::size_t>(j);
            plus_[at] = state.moved(detail::scaled(offset(j), axis));
            minus_[at] = state.moved(detail::scaled(-offset(j), axis));
        }
    }

    /// The range along the unit ray u.
    [[nodiscard]] linear_range operator()(const Eigen::Vector3d& u) const {
        linear_range z{0.0, {0.0, 0.0, 0.0}};
        double squares = 0.0;
        double explained = 0.0;
        for (int j = 0; j < 3; ++j) {
            const auto at = static_cast<std::size_t>(j);
            const double plus = plus_[at].range(anchor_, u);
            const double minus = minus_[at].range(anchor_, u);
            const double slope = (plus - minus) / (2.0 * offset(j));
            z.value += (plus + minus) / 6.0;
            z.slope = detail::combined(1.0, z.slope, slope, detail::column(spread_.vectors, j));
            squares += (plus * plus + minus * minus) / 6.0;
            explained += slope * slope * spread_.values[j];
        }
        z.variance = std::max(0.0, squares - z.value * z.value - explained);
        return z;
    }

  private:
    [[nodiscard]] double offset(int j) const { return std::sqrt(3.0 * spread_.values[j]); }

    const Eigen::Vector3d& anchor_;
    eigen_decomposition spread_;
    std::array<plane_state, 3> plus_;
    std::array<plane_state, 3> minus_;
};

/// Models `ray_estimator`. Needs three neighbors. O(k), some ten times as long as `plane_pca`.
///
/// Trust: that of `plane_pca`; `weak` as well where the iteration does not settle, or the rays
/// graze the plane so that their ranges say nothing and the covariance is that of the prior.
template <range_linearization Linearization>
struct plane_filter {
    static constexpr auto sensitive_to = sensitivity::units;

    double sigma = 0.015;         ///< standard deviation of the range [m]
    int max_iterations = 10;      ///< of the update; three or four are usual
    double prior_angle = 1.5;     ///< standard deviation of the prior normal [rad]
    double prior_distance = 1.0;  ///< and of the prior distance [m]; both say nothing

    /// @throws std::invalid_argument  unless sigma and the prior's deviations are positive and
    ///                                finite, and there is an iteration
    [[nodiscard]] with_covariance_of<plane_fit> operator()(const Eigen::Vector3d& p, ring_view ring,
                                                           const Eigen::Vector3d& viewpoint = {
                                                               0.0, 0.0, 0.0}) const {
        detail::require_sigma(sigma);
        detail::require(max_iterations >= 1, "plane_filter: needs an iteration");
        detail::require(prior_angle > 0.0 && std::isfinite(prior_angle) && prior_distance > 0.0 &&
                            std::isfinite(prior_distance),
                        "plane_filter: the prior's deviations must be positive and finite");
        with_covariance_of<plane_fit> belief;
        if (ring.size() < 3) return belief;
        const moments m = moments_about(p, ring);
        static_cast<plane_fit&>(belief) = plane_pca{}(m);
        if (!usable(belief.trust)) return belief;

        // Everything as seen from the view point.
        const Eigen::Vector3d x = detail::difference(p, viewpoint);
        const Eigen::Vector3d anchor = detail::combined(1.0, x, 1.0, m.mean_with_point());
        const plane_state prior{detail::tangent_basis(belief.normal)};
        plane_state state = prior;
        // No covariance yet: sigma points this near to each other give the derivative.
        state.covariance = detail::diagonal(1e-8, 1e-8, 1e-4 * sigma * sigma);
        bool settled = false;
        for (int i = 0; i < max_iterations && !settled; ++i) {
            // Measurements add up as information, without the loss that subtracting variances
            // means. The prior comes first: its mean and its precision as seen from the state.
            Eigen::Vector3d towards_prior = state.frame.towards(prior.frame.normal);
            towards_prior[2] = prior.distance - state.distance;
            information sum;
            sum.precision = detail::diagonal(1.0 / (prior_angle * prior_angle),
                                             1.0 / (prior_angle * prior_angle),
                                             1.0 / (prior_distance * prior_distance));
            sum.weighted = detail::product(sum.precision, towards_prior);
            const Linearization linearize(state, anchor);
            take_in(state, linearize, x, sum);
            for (const Eigen::Vector3d& q : ring)
                take_in(state, linearize, detail::difference(q, viewpoint), sum);

            const Eigen::Matrix3d covariance = detail::inverse_of_symmetric(sum.precision);
            const Eigen::Vector3d delta = detail::product(covariance, sum.weighted);
            if (!detail::all_finite(delta) || !detail::all_finite(covariance))
                return unsettled(belief);
            state = state.moved(delta);
            state.covariance = covariance;
            settled = std::abs(delta[0]) + std::abs(delta[1]) < 1e-9;
        }
        const Eigen::Matrix3d& c = state.covariance;
        belief.normal = state.frame.normal;
        belief.covariance = state.frame.in_space(c(0, 0), c(0, 1), c(1, 1));
        if (!settled) belief.trust = trust::weak;
        detail::distrust_if_vague(belief);
        return belief;
    }

  private:
    /// What is known of the state's deviation: its precision, and that times its mean.
    struct information {
        Eigen::Matrix3d precision;
        Eigen::Vector3d weighted;
    };

    /// Takes in the range of one measured point, x from the view point.
    void take_in(const plane_state& state, const Linearization& linearize, const Eigen::Vector3d& x,
                 information& sum) const {
        const double range = detail::length(x);
        const Eigen::Vector3d u = detail::scaled(1.0 / range, x);
        if (!(std::abs(detail::dot(u, state.frame.normal)) > detail::grazing_cosine)) return;
        const linear_range z = linearize(u);
        const double precision = 1.0 / (z.variance + sigma * sigma);
        if (!std::isfinite(precision * (z.value + z.slope[0] + z.slope[1] + z.slope[2]))) return;
        detail::add_outer(sum.precision, precision, z.slope, z.slope);
        sum.weighted = detail::combined(1.0, sum.weighted, precision * (range - z.value), z.slope);
    }

    static with_covariance_of<plane_fit> unsettled(with_covariance_of<plane_fit> belief) {
        belief.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
        belief.trust = trust::degenerate;
        return belief;
    }
};

/// The extended Kalman filter, iterated.
using plane_ekf = plane_filter<by_derivative>;

/// The unscented Kalman filter, iterated: for strong noise and grazing rays.
using plane_ukf = plane_filter<by_sigma_points>;

}  // namespace gnomon
