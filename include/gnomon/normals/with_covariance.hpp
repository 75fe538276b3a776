// SPDX-License-Identifier: BSL-1.0
/// @file
/// A covariance for the normals of any estimator: how the errors of the points turn the least
/// squares plane, to first order. Exact for PlanePCA, whose perturbation it is; for other methods
/// what a least squares fit with their normal would be worth on the same neighborhood.
///
/// With the tangent coordinates t_j of the points about their centroid and their errors e_j along
/// the normal, the normal turns by -A^-1 mean(t_j e_j), where A is the covariance of the t_j less
/// the variance along the normal (Kanatani 1996; Wang et al. 2001 for noise along rays).
#pragma once

#include <functional>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>

namespace gnomon {

/// Models `ray_estimator`, around any estimator whose result is a struct. O(k) more than that.
///
/// Trust: the estimator's; `weak` as well where the covariance exceeds 20 degrees, or rays graze
/// the plane so that nothing is known.
///
/// @tparam E  the estimator that gives the normal, e.g. `with_covariance<plane_pca>{.sigma = 0.01}`
template <estimator E>
    requires normal_estimate<estimator_result_t<E>>
struct with_covariance {
    static constexpr auto sensitive_to = sensitivity_of<E>();

    double sigma = 0.015;  ///< standard deviation of the range, along the ray [m]
    E estimate = {};

    /// @throws std::invalid_argument  unless sigma is positive and finite
    [[nodiscard]] with_covariance_of<estimate_t<E>> operator()(const Eigen::Vector3d& p,
                                                               ring_view ring,
                                                               const Eigen::Vector3d& viewpoint = {
                                                                   0.0, 0.0, 0.0}) const {
        detail::require_sigma(sigma);
        with_covariance_of<estimate_t<E>> belief;
        if constexpr (ray_estimator<E>) {
            static_cast<estimate_t<E>&>(belief) = std::invoke(estimate, p, ring, viewpoint);
        } else {
            static_cast<estimate_t<E>&>(belief) = std::invoke(estimate, p, ring);
        }
        if (!usable(belief.trust)) return belief;

        const double size = detail::length(belief.normal);  // somebody's estimator may forget it
        if (!(size > 0.0) || !std::isfinite(size)) {
            belief.trust = trust::degenerate;
            belief.normal = Eigen::Vector3d(0.0, 0.0, 0.0);
            return belief;
        }
        if (std::abs(size - 1.0) > 1e-12) belief.normal = detail::scaled(1.0 / size, belief.normal);
        const detail::tangent_basis frame(belief.normal);
        const auto& [n, b1, b2] = frame;
        const moments m = moments_about(p, ring);
        const Eigen::Matrix3d spread = m.covariance_with_point();
        const double across = detail::dot(n, detail::product(spread, n));
        const double a11 = detail::dot(b1, detail::product(spread, b1)) - across;
        const double a12 = detail::dot(b1, detail::product(spread, b2));
        const double a22 = detail::dot(b2, detail::product(spread, b2)) - across;

        // The covariance of mean(t_j e_j), in which e_j = (u_j . n) times the error of the range.
        const double count = static_cast<double>(m.count + 1);
        const Eigen::Vector3d mean = m.mean_with_point();
        double s11 = 0.0;
        double s12 = 0.0;
        double s22 = 0.0;
        bool seen = false;  // not merely grazed
        const auto add = [&](const Eigen::Vector3d& q) {
            const Eigen::Vector3d ray = detail::difference(q, viewpoint);
            const double range = detail::length(ray);
            // A point at the view point may have come from anywhere: then from straight ahead.
            const double cosine = range > 0.0 ? detail::dot(ray, n) / range : 1.0;
            const Eigen::Vector3d d = detail::difference(detail::difference(q, p), mean);
            const double t1 = cosine * detail::dot(d, b1);
            const double t2 = cosine * detail::dot(d, b2);
            s11 += t1 * t1;
            s12 += t1 * t2;
            s22 += t2 * t2;
            seen = seen || std::abs(cosine) > detail::grazing_cosine;
        };
        add(p);
        for (const Eigen::Vector3d& q : ring) add(q);
        const double w = sigma * sigma / (count * count);

        // P = A^-1 S A^-1
        const double determinant = a11 * a22 - a12 * a12;
        const double i11 = a22 / determinant;
        const double i12 = -a12 / determinant;
        const double i22 = a11 / determinant;
        const double r11 = i11 * s11 + i12 * s12;
        const double r12 = i11 * s12 + i12 * s22;
        const double r21 = i12 * s11 + i22 * s12;
        const double r22 = i12 * s12 + i22 * s22;
        belief.covariance = frame.in_space(w * (r11 * i11 + r12 * i12), w * (r11 * i12 + r12 * i22),
                                           w * (r21 * i12 + r22 * i22));
        // Around other methods than PlanePCA, A need not be one of a plane.
        const bool is_plane = a11 > 0.0 && determinant > 0.0;
        if (!seen || !is_plane || !detail::all_finite(belief.covariance)) {
            constexpr double anywhere = 2.25;  // [rad^2], as far as one can be wrong
            belief.covariance = frame.in_space(anywhere, 0.0, anywhere);
            belief.trust = trust::weak;
        }
        detail::distrust_if_vague(belief);
        return belief;
    }
};

template <class E>
with_covariance(double, E) -> with_covariance<E>;

}  // namespace gnomon
