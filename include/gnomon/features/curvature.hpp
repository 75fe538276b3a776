// SPDX-License-Identifier: BSL-1.0
/// @file
/// How a surface bends at a point: principal curvatures and their directions, Gaussian and mean
/// curvature, from a quadratic fitted to a neighborhood in the frame of its normal.
///
/// Signs: bent towards the normal is positive. With normals that face the sensor (Eq. (3.20),
/// `orient_normals`) what is convex towards the sensor has H < 0, as in Besl and Jain.
///
/// A *curvature estimator* is called with a point, its normal and the ring of its neighbors and
/// returns a `curvature` or something derived from it. Its laws, checked in
/// tests/features/curvature_test.cpp: an unusable result is zero throughout and nothing is ever
/// NaN; the order of the ring and the place of the cloud do not matter; directions turn with the
/// cloud, curvatures do not change; a cloud s times as large has curvatures 1/s as large; the
/// opposite normal has opposite curvatures.
///
/// Models: `shape_operator_curvature`, and `thesis_curvature`, which breaks the law of scale.
///
/// Klasing 2010, Sec. 3.3; P. Besl and R. Jain 1988.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/eigen_2x2.hpp>
#include <gnomon/features/detail/height_frame.hpp>
#include <gnomon/features/detail/quadric_fit.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The second order of a surface at a point. All zero where the trust is not usable.
struct curvature {
    double kappa1 = 0.0;  ///< the larger principal curvature [1/m]
    double kappa2 = 0.0;  ///< the smaller one [1/m]
    /// The principal directions, perpendicular unit vectors of arbitrary sign; direction1 x
    /// direction2 is the normal of the fitted surface. Where kappa1 = kappa2, as on a sphere and on
    /// a plane, any two directions are principal, and the data's noise chooses.
    Eigen::Vector3d direction1{0.0, 0.0, 0.0};
    Eigen::Vector3d direction2{0.0, 0.0, 0.0};
    gnomon::trust trust = gnomon::trust::too_few_neighbors;

    /// K [1/m^2], Eq. (3.23).
    [[nodiscard]] double gaussian() const { return kappa1 * kappa2; }
    /// H [1/m], Eq. (3.24).
    [[nodiscard]] double mean() const { return 0.5 * (kappa1 + kappa2); }
};

/// What c(point, normal, ring) gives.
template <class C>
using curvature_result_t = std::remove_cvref_t<
    std::invoke_result_t<const C&, const Eigen::Vector3d&, const Eigen::Vector3d&, ring_view>>;

/// c(point, normal, ring) gives a `curvature`. Const and thread-safe.
template <class C>
concept curvature_estimator =
    std::invocable<const C&, const Eigen::Vector3d&, const Eigen::Vector3d&, ring_view> &&
    std::derived_from<curvature_result_t<C>, curvature> &&
    std::default_initializable<curvature_result_t<C>>;

namespace detail {

/// The curvature of the surface z = e x + f y + a x^2 + b x y + c y^2 of a frame above its origin.
/// Where the surface is inclined to the frame, its own tangent plane counts: S is the second
/// fundamental form in an orthonormal basis of that plane, t1 up the gradient and t2 across.
[[nodiscard]] inline curvature curvature_of(const quadric& q, const height_frame& frame) {
    const double slope = std::sqrt(q.e * q.e + q.f * q.f);
    const double gx = slope > 0.0 ? q.e / slope : 1.0;
    const double gy = slope > 0.0 ? q.f / slope : 0.0;
    const double w = std::sqrt(1.0 + slope * slope);
    // Second derivatives along the gradient (g) and across (t), from the Hessian of Eq. (3.22).
    const double gg = 2.0 * (gx * gx * q.a + gx * gy * q.b + gy * gy * q.c);
    const double gt = 2.0 * gx * gy * (q.c - q.a) + (gx * gx - gy * gy) * q.b;
    const double tt = 2.0 * (gy * gy * q.a - gx * gy * q.b + gx * gx * q.c);
    const eigen_2x2 s(gg / (w * w * w), gt / (w * w), tt / w);

    curvature result;
    if (!std::isfinite(s.larger * s.larger + s.smaller * s.smaller)) {
        result.trust =
            trust::degenerate;  // too small a neighborhood for its inverse to be a number
        return result;
    }
    result.kappa1 = s.larger;
    result.kappa2 = s.smaller;
    const Eigen::Vector3d t1 = frame.direction(gx / w, gy / w, slope / w);
    const Eigen::Vector3d t2 = frame.direction(-gy, gx, 0.0);
    result.direction1 = combined(s.c, t1, s.s, t2);
    result.direction2 = combined(s.c, t2, -s.s, t1);
    result.trust = frame.trust;
    return result;
}

}  // namespace detail

/// The default: least squares of z = a x^2 + b xy + c y^2 + e x + f y + g over the ring and the
/// point, then the shape operator. Neither the point nor its normal need be exact, as those of the
/// thesis's form must: the constant and the first-order terms take up what they are off.
///
/// Models `curvature_estimator`. Needs five neighbors. O(k), nothing on the heap.
///
/// The normal may have any length; zero stands for none. Trust: `not_finite` if the point, its
/// normal or a neighbor is not; `degenerate` without a normal, and where ring and point do not
/// determine six coefficients (fewer than six places, or all on one conic: one or two scan lines,
/// or a circle about the axis of a rotating scanner); `weak` where they hardly do, or spread in one
/// direction mainly.
struct shape_operator_curvature {
    double min_aspect_ratio = 0.1;  ///< sigma_ar in the tangent plane below which trust is weak
    /// Share of a column of the fit that the columns before it leave unexplained, at the least; its
    /// inverse is the factor by which noise is amplified (variance inflation). Below, it is weak.
    double min_independence = 1e-2;

    [[nodiscard]] curvature operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       ring_view ring) const {
        detail::height_frame frame(p, normal, ring, 5, min_aspect_ratio);
        curvature none;
        none.trust = frame.trust;
        if (!usable(frame.trust)) return none;
        detail::least_squares_quadric fit;
        fit.add(0.0, 0.0, 0.0);
        for (const Eigen::Vector3d& q : ring) {
            // Scaled to one along both axes: the sums then are as well conditioned as the ring's
            // shape permits, whatever its size.
            const auto [x, y, z] = frame(q);
            fit.add(x / frame.rms_x, y / frame.rms_y, z);
        }
        const double independence = fit.solve();
        constexpr double rounding = 1e-10;  // of the sums, with some digits to spare
        if (!(independence > rounding)) {
            none.trust = trust::degenerate;
            return none;
        }
        if (independence < min_independence) frame.trust = trust::weak;
        return detail::curvature_of(fit.solution(1.0 / frame.rms_x, 1.0 / frame.rms_y), frame);
    }
};

/// The thesis to the letter, Eqs. (3.25) to (3.27): the unit vector [a' b' c' d'] that makes the
/// rows a' x^2 + b' xy + c' y^2 + d' z least, without a constant and in metres, a = -a'/d' and so
/// on; K = 4ac - b^2, H = a + c (specification A13). It trusts point and normal to be exact.
///
/// Models `curvature_estimator`, but breaks the law of scale: the unit vector mixes units, and so
/// the fit depends on what a metre is unless the residual is zero. Where z is noisier than the ring
/// is wide squared, the smallest quadrics, xy and x^2 - y^2, win: it sees saddles everywhere, those
/// of Fig. 3.14. Needs three neighbors. O(k), nothing on the heap. From the matrix R^T R, so the
/// relative error is about 1e-16 (s_1 / s_3)^2 in singular values of R.
///
/// Normal and trust: as above; `degenerate` also where the least singular value is double, or
/// its vector is without z.
struct thesis_curvature {
    double min_aspect_ratio = 0.1;  ///< sigma_ar in the tangent plane below which trust is weak

    [[nodiscard]] curvature operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       ring_view ring) const {
        const detail::height_frame frame(p, normal, ring, 3, min_aspect_ratio);
        curvature none;
        none.trust = frame.trust;
        if (!usable(frame.trust)) return none;
        detail::homogeneous_quadric fit;
        for (const Eigen::Vector3d& q : ring) {
            const auto [x, y, z] = frame(q);
            fit.add(x, y, z);
        }
        const auto solution = fit.solve();
        if (!solution) {
            none.trust = trust::degenerate;
            return none;
        }
        return detail::curvature_of(*solution, frame);
    }
};

}  // namespace gnomon
