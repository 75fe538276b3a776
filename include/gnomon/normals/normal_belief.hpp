// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a normal is worth: its covariance. A unit vector errs in the two directions across it, so
/// the covariance is that of a small rotation vector's effect, in radians squared, with nothing
/// along the normal.
///
/// Klasing 2010, Sec. 3.2.7 proposes trace and determinant as scalar measures.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

namespace detail {

/// A unit normal and two orthonormal directions across it.
struct tangent_basis {
    Eigen::Vector3d normal, b1, b2;

    explicit tangent_basis(const Eigen::Vector3d& n)
        : normal(n), b1(orthogonal(n)), b2(cross(n, b1)) {}

    /// The basis at n that turns least from one nearby, so that coordinates keep their meaning.
    tangent_basis(const Eigen::Vector3d& n, const tangent_basis& nearby) : normal(n) {
        const Eigen::Vector3d e = combined(1.0, nearby.b1, -dot(n, nearby.b1), n);
        b1 = scaled(1.0 / length(e), e);
        b2 = cross(n, b1);
    }

    /// The unit vector at the end of the rotation by (d1, d2) [rad]: the exponential on the sphere.
    [[nodiscard]] Eigen::Vector3d moved(double d1, double d2) const {
        const double angle = std::hypot(d1, d2);
        if (angle == 0.0) return normal;
        const double s = std::sin(angle) / angle;
        return combined(std::cos(angle), normal, s * d1, b1, s * d2, b2);
    }

    /// The turn (d1, d2, 0) [rad] from the normal to n or -n, whichever is nearer: the logarithm.
    [[nodiscard]] Eigen::Vector3d towards(const Eigen::Vector3d& n) const {
        const double along = dot(n, normal);
        const double x = dot(n, b1);
        const double y = dot(n, b2);
        const double across = std::hypot(x, y);
        if (across == 0.0) return {0.0, 0.0, 0.0};
        const double s = std::copysign(std::atan2(across, std::abs(along)) / across, along);
        return {s * x, s * y, 0.0};
    }

    /// The 3 x 3 covariance of a covariance in the coordinates (b1, b2).
    [[nodiscard]] Eigen::Matrix3d in_space(double p11, double p12, double p22) const {
        Eigen::Matrix3d p = diagonal(0.0, 0.0, 0.0);
        add_outer(p, p11, b1, b1);
        add_outer(p, p12, b1, b2);
        add_outer(p, p12, b2, b1);
        add_outer(p, p22, b2, b2);
        return p;
    }
};

/// Rays within about a degree of a plane say nothing of it.
inline constexpr double grazing_cosine = 0.02;

}  // namespace detail

/// An estimate together with the covariance of its normal; zero where that is not usable.
template <normal_estimate Estimate = normal_fit>
struct with_covariance_of : Estimate {
    Eigen::Matrix3d covariance =
        detail::diagonal(0.0, 0.0, 0.0);  ///< [rad^2], covariance * normal = 0

    /// The expected square of the angle between the normal and the true one [rad^2].
    [[nodiscard]] double trace() const {
        return covariance(0, 0) + covariance(1, 1) + covariance(2, 2);
    }

    /// The product of the variances along the two principal directions across the normal [rad^4].
    /// As a 3x3 determinant it would be zero.
    [[nodiscard]] double determinant() const {
        const auto minor = [this](int i, int j) {
            return covariance(i, i) * covariance(j, j) - covariance(i, j) * covariance(j, i);
        };
        return minor(0, 1) + minor(0, 2) + minor(1, 2);
    }
};

namespace detail {

/// Beyond this trace [rad^2], some 20 degrees, a normal is weak, however it was found.
inline constexpr double vague_trace = 0.1;

/// Makes a good estimate weak whose covariance says that it may be anything.
template <class Belief>
void distrust_if_vague(Belief& belief) {
    if (belief.trust == trust::good && !(belief.trace() <= vague_trace)) belief.trust = trust::weak;
}

}  // namespace detail

/// A normal with its covariance and no more.
using normal_belief = with_covariance_of<normal_fit>;

/// The normalized estimation error squared, delta^T P^-1 delta, of an estimate whose truth is
/// known: delta [rad] is the rotation from the estimated normal to the true one, in its two
/// directions across. For an honest covariance its mean is 2, and it exceeds 5.991 in 5 % of cases.
/// Of a singular covariance, which allows no error, it is infinite if there is one and else zero.
///
/// @param truth  the true unit normal; its sign does not matter
/// Precondition: the estimate is usable. Source: Bar-Shalom et al. 2001, Sec. 5.4.
template <normal_estimate Estimate>
[[nodiscard]] double nees(const with_covariance_of<Estimate>& estimate,
                          const Eigen::Vector3d& truth) {
    const detail::tangent_basis frame(estimate.normal);
    const Eigen::Vector3d d = frame.towards(truth);
    const auto& [n, b1, b2] = frame;
    const Eigen::Vector3d p1 = detail::product(estimate.covariance, b1);
    double p11 = detail::dot(b1, p1);
    double p12 = detail::dot(b2, p1);
    double p22 = detail::dot(b2, detail::product(estimate.covariance, b2));
    const double scale = detail::power_to_one(std::max(p11, p22));  // products must be numbers
    for (double* p : {&p11, &p12, &p22}) *p *= scale;
    const double determinant = p11 * p22 - p12 * p12;
    if (determinant <= 0.0)
        return d[0] == 0.0 && d[1] == 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
    return (p22 * d[0] * d[0] - 2.0 * p12 * d[0] * d[1] + p11 * d[1] * d[1]) / determinant * scale;
}

}  // namespace gnomon
