// SPDX-License-Identifier: BSL-1.0
/// @file
/// The covariance of a normal. A unit vector has two degrees of freedom: the covariance is that of
/// the difference of the true and the estimated normal in the tangent plane, in rad^2, and zero
/// along the normal. (The covariance of the rotation vector has the same eigenvalues, in directions
/// turned by 90 degrees about the normal.)
///
/// Klasing 2010, Sec. 3.2.7 proposes trace and determinant as scalar measures.
#pragma once

#include <algorithm>
#include <limits>
#include <numbers>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/tangent_basis.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// An estimate together with the covariance of its normal.
///
/// The covariance of a usable normal is finite, and no eigenvalue is above (pi/2)^2, since the
/// angle between two axes is at most pi/2: that value means that nothing is known about this
/// direction. A normal whose covariance has a trace above 0.09 rad^2 (17 degrees) is at best
/// `weak`. The covariance of an unusable normal is zero.
///
/// @tparam Estimate  the estimate that the covariance is added to
template <normal_estimate Estimate = normal_fit>
struct normal_belief : Estimate {
    Eigen::Matrix3d covariance =
        detail::diagonal(0.0, 0.0, 0.0);  ///< [rad^2], covariance * normal = 0

    /// The expected square of the angle between the normal and the true one [rad^2].
    [[nodiscard]] double trace() const {
        return covariance(0, 0) + covariance(1, 1) + covariance(2, 2);
    }

    /// The product of the variances along the two principal directions of the tangent plane
    /// [rad^4]. The 3 x 3 determinant is zero.
    [[nodiscard]] double determinant() const {
        const auto minor = [this](int i, int j) {
            return covariance(i, i) * covariance(j, j) - covariance(i, j) * covariance(j, i);
        };
        return minor(0, 1) + minor(0, 2) + minor(1, 2);
    }
};

namespace detail {

/// The largest variance of an axis [rad^2]: the angle between two axes is at most pi/2.
inline constexpr double largest_variance = 0.25 * std::numbers::pi * std::numbers::pi;

/// The trace [rad^2] above which a normal is weak: a root mean square angle of 0.3 rad, 17 degrees,
/// where the covariance of first order no longer describes the distribution on the sphere. (Chosen
/// on furnished and convex rooms 20,001 to 20,010 and 30,001 to 30,010: of 15 to 30 mm of noise,
/// .02 % of the good normals of `plane_pca` are off by more than 40 degrees, at most .09 % in one
/// setting; at 0.1 rad^2 these are .03 and .14 %, at 0.08 a twentieth of the normals more is weak.)
inline constexpr double vague_trace = 0.09;  // [rad^2]; source: above

/// A ray is grazing if the cosine between ray and normal is below this (88.9 degrees): its range is
/// then so sensitive to the normal that a linear error model does not hold. (A cosine, without a
/// unit; chosen here, not in the thesis.)
inline constexpr double grazing_cosine = 0.02;

/// By how many standard deviations the slope of a plane may be less than estimated (a number; a
/// normal distribution exceeds it to one side in 1 of 740 cases; chosen on furnished rooms 20,001
/// to 20,010, where 2 and 3 give the same covariances).
inline constexpr double vague_deviations = 3.0;

/// The covariance of a normal about which nothing is known.
inline constexpr tangent_matrix no_knowledge{largest_variance, 0.0, largest_variance};

/// The covariance with its eigenvalues limited to [0, largest_variance]. A covariance that is not
/// finite has overflowed: nothing is known. The smaller eigenvalue is not set below what rounding
/// of the larger one hides.
[[nodiscard]] inline tangent_matrix limited_covariance(const tangent_matrix& p) {
    // Also if these products underflow.
    const bool is_definite = p.p11 > 0.0 && p.p12 * p.p12 < p.p11 * p.p22;
    if (is_definite && p.p11 + p.p22 <= largest_variance) return p;  // performance only
    const double mean = 0.5 * p.p11 + 0.5 * p.p22;
    const double half_difference = 0.5 * p.p11 - 0.5 * p.p22;
    const double radius = std::hypot(half_difference, p.p12);
    if (!std::isfinite(mean + radius)) return no_knowledge;
    const double larger = mean + radius;
    const double rounding = 4.0 * std::numeric_limits<double>::epsilon() * larger;
    if (larger <= largest_variance && mean - radius >= -rounding) return p;
    const double smaller = std::max(mean - radius, rounding);
    const double l1 = std::clamp(larger, 0.0, largest_variance);
    const double l2 = std::clamp(smaller, 0.0, largest_variance);
    const double angle = 0.5 * std::atan2(p.p12, half_difference);  // of the larger's direction
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {l1 * c * c + l2 * s * s, (l1 - l2) * c * s, l1 * s * s + l2 * c * c};
}

/// Whether a normal may be a vague one that noise makes look certain: where noise has tilted a
/// small neighborhood along the ray, the plane looks steep, and an error of its slope is a small
/// angle. The slope across the ray, the tangent of the angle between ray and normal, has nearly the
/// same deviation whatever it is. If the trace is above `vague_trace` at the slope that is this
/// number of deviations less, the normal is vague.
/// @param u  the direction of the ray, of length 1
[[nodiscard]] inline bool is_vague_within(double deviations, const tangent_basis& frame,
                                          const tangent_matrix& p, const Eigen::Vector3d& u) {
    const double cosine = std::abs(dot(u, frame.normal));
    if (!(cosine > grazing_cosine)) return true;
    const double x = dot(u, frame.b1), y = dot(u, frame.b2);  // the ray in the tangent plane
    const double sine = std::hypot(x, y);
    const double c = sine > 0.0 ? x / sine : 1.0, s = sine > 0.0 ? y / sine : 0.0;
    // Deviations of the slope, and of the turn about the ray.
    const double of_slope = std::sqrt(std::max(0.0, p.along(c, s))) / (cosine * cosine);
    const double of_turn = std::sqrt(std::max(0.0, p.along(-s, c))) / cosine;
    const double flatter = std::max(0.0, sine / cosine - deviations * of_slope);
    const double secant = 1.0 + flatter * flatter;  // squared
    const double trace = of_slope * of_slope / (secant * secant) + of_turn * of_turn / secant;
    return !(trace <= vague_trace);
}

/// Gives a usable estimate the covariance `p` in the coordinates of the basis at its normal,
/// limited to what is possible; a good estimate becomes weak if its trace is above `vague_trace`.
/// All covariances of normals are set here.
template <class Estimate>
void set_covariance(normal_belief<Estimate>& belief, const tangent_basis& frame,
                    const tangent_matrix& p) {
    belief.covariance = frame.in_space(limited_covariance(p));
    if (belief.trust == trust::good && !(belief.trace() <= vague_trace)) belief.trust = trust::weak;
}

/// The same; a good estimate also becomes weak where it is vague within `vague_deviations`.
/// @param ray  from the view point to the point [m]; if it is zero, the estimate is weak
template <class Estimate>
void set_covariance(normal_belief<Estimate>& belief, const tangent_basis& frame,
                    const tangent_matrix& p, const Eigen::Vector3d& ray) {
    set_covariance(belief, frame, p);
    if (belief.trust == trust::good &&
        is_vague_within(vague_deviations, frame, p, scaled(1.0 / length(ray), ray)))
        belief.trust = trust::weak;
}

}  // namespace detail

/// The normalized estimation error squared, delta^T P^-1 delta, of an estimate whose true normal is
/// known: delta [rad] is the rotation from the estimated normal to the true one, in coordinates of
/// the tangent plane. If the covariance is consistent, it has a chi-square distribution with two
/// degrees of freedom: its mean is 2, and 5 % of the values are above 5.991. If the covariance is
/// singular, it is zero without an error and else infinite.
///
/// @param truth  the true unit normal; its sign does not matter
/// Precondition: the estimate is usable. Source: Bar-Shalom et al. 2001, Sec. 5.4.
template <normal_estimate Estimate>
[[nodiscard]] double nees(const normal_belief<Estimate>& estimate, const Eigen::Vector3d& truth) {
    const detail::tangent_basis frame(estimate.normal);
    const Eigen::Vector3d d = frame.towards(truth);
    auto [p11, p12, p22] = frame.restricted(estimate.covariance);
    const double scale =
        detail::power_to_one(std::max(p11, p22));  // no product under- or overflows
    for (double* p : {&p11, &p12, &p22}) *p *= scale;
    const double determinant = p11 * p22 - p12 * p12;
    if (determinant <= 0.0)
        return d[0] == 0.0 && d[1] == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
    return (p22 * d[0] * d[0] - 2.0 * p12 * d[0] * d[1] + p11 * d[1] * d[1]) / determinant * scale;
}

}  // namespace gnomon
