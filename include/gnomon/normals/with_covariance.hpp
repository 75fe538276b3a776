// SPDX-License-Identifier: BSL-1.0
/// @file
/// A covariance for the normal of any estimator: the error of the least squares plane that errors
/// of the points cause, to first order. It is exact for PlanePCA. For other methods it is the
/// covariance that a least squares plane with their normal would have on the same neighborhood.
///
/// Let t_j be the coordinates of the points in the tangent plane, about their centroid, and e_j
/// their errors along the normal. Then the normal rotates by -A^-1 mean(t_j e_j), where A is the
/// covariance of the t_j of the points without their noise: that of the measured points minus that
/// of the noise (Kanatani 1996; Wang et al. 2001 for noise along rays). Where the noise is most of
/// it, the points do not determine a plane.
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
/// Trust: the estimator's; `weak` as well where the trace of the covariance is above 0.09 rad^2, or
/// would be for a plane whose slope across the ray is 3 standard deviations less. The covariance is
/// (pi/2)^2 in both directions, its largest value, where the ray is grazing, or where the points
/// without their noise do not form a plane: they must exceed it significantly, by 3 standard
/// deviations of a sample variance, in the direction of the tangent plane that is most along the
/// rays. `not_finite` where the view point is not finite.
///
/// @tparam E  the estimator that gives the normal, e.g. `with_covariance<plane_pca>`
template <estimator E>
    requires normal_estimate<detail::estimator_result_t<E>>
struct with_covariance {
    static constexpr auto sensitive_to = detail::sensitivity_of<E>();

    noise_curve noise = constant_noise{};  ///< of the sensor
    E estimate = {};                       ///< the estimator whose normals these are

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
        detail::set_covariance(belief, frame, covariance_in(frame, p, neighbors, viewpoint),
                               detail::difference(p, viewpoint));
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
        const auto count = static_cast<double>(m.count + 1);
        const Eigen::Vector3d mean = m.mean_with_point();
        detail::tangent_matrix noisy{0.0, 0.0, 0.0}, s{0.0, 0.0, 0.0};
        const auto add = [&](const Eigen::Vector3d& q) {
            const Eigen::Vector3d ray = detail::difference(q, viewpoint);
            const double range = detail::length(ray);
            // A point at the view point has no ray, and counts as one with the ray along the
            // normal.
            const Eigen::Vector3d u = range > 0.0 ? detail::scaled(1.0 / range, ray) : frame.normal;
            const double cosine = detail::dot(u, frame.normal);
            const double variance = noise.variance_along(ray);
            noisy.add(variance, detail::dot(u, frame.b1), detail::dot(u, frame.b2));
            // e_j is the error of the range times this cosine.
            const Eigen::Vector3d d = detail::difference(detail::difference(q, p), mean);
            s.add(variance * cosine * cosine, detail::dot(d, frame.b1), detail::dot(d, frame.b2));
        };
        add(p);
        for (const Eigen::Vector3d& q : neighbors) add(q);
        const detail::tangent_matrix spread = frame.restricted(m.covariance_with_point());
        const Eigen::Vector3d ray =
            detail::combined(1.0, detail::difference(p, viewpoint), 1.0, mean);
        // Of n points: the centroid has a part 1 / n of their noise.
        const double part = (count - 1.0) / (count * count);
        if (!is_significant(spread, noisy, part, frame, ray, count)) return detail::no_knowledge;
        const double a11 = spread.p11 - part * noisy.p11;
        const double a12 = spread.p12 - part * noisy.p12;
        const double a22 = spread.p22 - part * noisy.p22;
        const double determinant = a11 * a22 - a12 * a12;
        if (!(a11 > 0.0 && determinant > 0.0)) return detail::no_knowledge;
        const double i11 = a22 / determinant;
        const double i12 = -a12 / determinant;
        const double i22 = a11 / determinant;
        const double r11 = i11 * s.p11 + i12 * s.p12;
        const double r12 = i11 * s.p12 + i12 * s.p22;
        const double r22 = i12 * s.p12 + i22 * s.p22;
        const double w = 1.0 / (count * count);
        return {w * (r11 * i11 + r12 * i12), w * (r11 * i12 + r12 * i22),
                w * ((i12 * s.p11 + i22 * s.p12) * i12 + r22 * i22)};
    }

    /// Whether the points extend along the ray, in the tangent plane, by more than their noise.
    /// @param part  of `noisy`, the sum of the noise of all points, that is in their covariance
    [[nodiscard]] static bool is_significant(const detail::tangent_matrix& spread,
                                             const detail::tangent_matrix& noisy, double part,
                                             const detail::tangent_basis& frame,
                                             const Eigen::Vector3d& ray, double count) {
        const double x = detail::dot(ray, frame.b1), y = detail::dot(ray, frame.b2);
        constexpr double deviations = 3.0;  // of a sample variance, whose is sqrt(2 / count) of it
        const bool is_grazing = !(std::abs(detail::dot(ray, frame.normal)) >
                                  detail::grazing_cosine * detail::length(ray));
        return !is_grazing && spread.along(x, y) >= part * noisy.along(x, y) *
                                                        (1.0 + deviations * std::sqrt(2.0 / count));
    }
};

template <class E>
with_covariance(noise_curve, E) -> with_covariance<E>;

}  // namespace gnomon
