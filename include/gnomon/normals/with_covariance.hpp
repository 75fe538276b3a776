// SPDX-License-Identifier: BSL-1.0
/// @file
/// A covariance for the normal of any estimator: the error of the least squares plane that errors
/// of the points cause, to first order. It is exact for PlanePCA. For other methods it is the
/// covariance that a least squares plane with their normal would have on the same neighborhood.
///
/// Let t_j be the coordinates of the points in the tangent plane, about their centroid, and e_j
/// their errors along the normal. Then the normal rotates by -A^-1 mean(t_j e_j), where A is the
/// covariance of the t_j minus the variance along the normal (Kanatani 1996; Wang et al. 2001 for
/// noise along rays).
#pragma once

#include <functional>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/require_noise.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>

namespace gnomon {

/// Models `ray_estimator`. Wraps any estimator whose result is a `normal_estimate`. O(k) more than
/// the estimator.
///
/// Trust: the estimator's; `weak` as well where the trace of the covariance is above 0.1 rad^2. The
/// covariance is (pi/2)^2 in both directions, its largest value, where all rays are grazing or the
/// points do not form a plane with this normal. `not_finite` where the view point is not finite.
///
/// @tparam E  the estimator that gives the normal, e.g. `with_covariance<plane_pca>`
template <estimator E>
    requires normal_estimate<detail::estimator_result_t<E>>
struct with_covariance {
    static constexpr auto sensitive_to = detail::sensitivity_of<E>();

    noise_curve noise = constant_noise{};  ///< of the sensor
    E estimate = {};

    /// @throws std::invalid_argument  if the noise is 0
    [[nodiscard]] normal_belief<estimate_t<E>> operator()(const Eigen::Vector3d& p,
                                                          neighborhood_view neighbors,
                                                          const Eigen::Vector3d& viewpoint = {
                                                              0.0, 0.0, 0.0}) const {
        detail::require_noise(noise);
        normal_belief<estimate_t<E>> belief;
        if constexpr (ray_estimator<E>) {
            static_cast<estimate_t<E>&>(belief) = std::invoke(estimate, p, neighbors, viewpoint);
        } else {
            static_cast<estimate_t<E>&>(belief) = std::invoke(estimate, p, neighbors);
        }
        if (!usable(belief.trust)) return belief;
        normalize(belief);
        if (!is_finite(viewpoint)) belief.trust = trust::not_finite;
        if (!usable(belief.trust)) {
            belief.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
            return belief;
        }
        const detail::tangent_basis frame(belief.normal);
        detail::set_covariance(belief, frame, covariance_in(frame, p, neighbors, viewpoint));
        return belief;
    }

  private:
    /// Divides the normal by its length, for estimators that do not.
    static void normalize(estimate_t<E>& estimate) {
        const double size = detail::length(estimate.normal);
        if (!(size > 0.0) || !std::isfinite(size)) {
            estimate.trust = trust::degenerate;
        } else if (std::abs(size - 1.0) > 1e-12) {
            estimate.normal = detail::scaled(1.0 / size, estimate.normal);
        }
    }

    /// P = A^-1 S A^-1, S being the covariance of mean(t_j e_j).
    [[nodiscard]] detail::tangent_matrix covariance_in(const detail::tangent_basis& frame,
                                                       const Eigen::Vector3d& p,
                                                       neighborhood_view neighbors,
                                                       const Eigen::Vector3d& viewpoint) const {
        const moments m = moments::about(p, neighbors);
        const Eigen::Matrix3d spread = m.covariance_with_point();
        const double across = detail::dot(frame.normal, detail::product(spread, frame.normal));
        auto [a11, a12, a22] = frame.restricted(spread);
        a11 -= across;
        a22 -= across;

        const Eigen::Vector3d mean = m.mean_with_point();
        double s11 = 0.0;
        double s12 = 0.0;
        double s22 = 0.0;
        bool all_grazing = true;
        const auto add = [&](const Eigen::Vector3d& q) {
            const Eigen::Vector3d ray = detail::difference(q, viewpoint);
            const double range = detail::length(ray);
            // e_j is the error of the range times this cosine; a point at the view point has no
            // ray, and counts as one with the ray along the normal.
            const double cosine = range > 0.0 ? detail::dot(ray, frame.normal) / range : 1.0;
            const Eigen::Vector3d d = detail::difference(detail::difference(q, p), mean);
            const double t1 = cosine * detail::dot(d, frame.b1);
            const double t2 = cosine * detail::dot(d, frame.b2);
            const double variance = noise.variance_along(ray);
            s11 += variance * t1 * t1;
            s12 += variance * t1 * t2;
            s22 += variance * t2 * t2;
            all_grazing = all_grazing && !(std::abs(cosine) > detail::grazing_cosine);
        };
        add(p);
        for (const Eigen::Vector3d& q : neighbors) add(q);
        const double determinant = a11 * a22 - a12 * a12;
        // A is that of a plane if it is positive definite; for PlanePCA it always is.
        if (all_grazing || !(a11 > 0.0 && determinant > 0.0)) return detail::no_knowledge;
        const double i11 = a22 / determinant;
        const double i12 = -a12 / determinant;
        const double i22 = a11 / determinant;
        const double r11 = i11 * s11 + i12 * s12;
        const double r12 = i11 * s12 + i12 * s22;
        const double r22 = i12 * s12 + i22 * s22;
        const double count = static_cast<double>(m.count + 1);
        const double w = 1.0 / (count * count);
        return {w * (r11 * i11 + r12 * i12), w * (r11 * i12 + r12 * i22),
                w * ((i12 * s11 + i22 * s12) * i12 + r22 * i22)};
    }
};

template <class E>
with_covariance(noise_curve, E) -> with_covariance<E>;

}  // namespace gnomon
