// SPDX-License-Identifier: BSL-1.0
/// @file
/// Curvature estimators: principal curvatures and directions, Gaussian and mean curvature of a
/// quadric that is fitted to the neighborhood of a point in the frame of its normal.
///
/// Sign convention: a surface that curves towards its normal has positive curvature. With normals
/// that face the sensor (Eq. (3.20), `orient_normals`), a surface convex towards the sensor has
/// H < 0, as in Besl and Jain.
///
/// A *curvature estimator* is called with a point, its normal and its neighbors, and returns a
/// `curvature` or a type derived from it. Its laws, as functions in tests/laws/curvature_laws.hpp:
/// an unusable result is zero in all members, and no result is NaN; the result is invariant to the
/// order of the neighbors and to translation; directions are equivariant and curvatures invariant
/// under rotation; scaling the cloud by s scales curvatures by 1/s; reversing the normal reverses
/// the signs of the curvatures.
///
/// Models: `shape_operator_curvature`; `thesis_curvature`, which violates the law of scale.
///
/// Klasing 2010, Sec. 3.3. P. Besl and R. Jain, Segmentation through variable-order surface
/// fitting, 1988.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/least_squares_quadric.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/detail/eigen_2x2.hpp>
#include <gnomon/features/detail/height_frame.hpp>
#include <gnomon/features/detail/quadric_fit.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The curvature of a surface at a point. All numbers are zero if the trust is not usable.
struct curvature {
    double kappa1 = 0.0;  ///< the larger principal curvature [1/m]
    double kappa2 = 0.0;  ///< the smaller one [1/m]
    /// The principal direction of kappa1, a unit vector of arbitrary sign. If kappa1 = kappa2, as
    /// on a sphere and on a plane, every tangent direction is principal, and noise decides.
    Eigen::Vector3d direction1{0.0, 0.0, 0.0};
    /// The principal direction of kappa2, a unit vector; direction1 x direction2 is the normal of
    /// the fitted quadric.
    Eigen::Vector3d direction2{0.0, 0.0, 0.0};
    /// Quality of the estimate; see the estimator.
    gnomon::trust trust = gnomon::trust::too_few_neighbors;

    /// The Gaussian curvature K [1/m^2], Eq. (3.23).
    [[nodiscard]] double gaussian() const { return kappa1 * kappa2; }
    /// The mean curvature H [1/m], Eq. (3.24).
    [[nodiscard]] double mean() const { return 0.5 * (kappa1 + kappa2); }
};

namespace detail {

/// The result type of c(point, normal, neighbors).
template <class C>
using curvature_result_t =
    std::remove_cvref_t<std::invoke_result_t<const C&, const Eigen::Vector3d&,
                                             const Eigen::Vector3d&, neighborhood_view>>;

}  // namespace detail

/// A const, thread-safe callable c(point, normal, neighbors) that returns a `curvature` or a type
/// derived from it. The laws are listed above.
template <class C>
concept curvature_estimator =
    std::invocable<const C&, const Eigen::Vector3d&, const Eigen::Vector3d&, neighborhood_view> &&
    std::derived_from<detail::curvature_result_t<C>, curvature> &&
    std::default_initializable<detail::curvature_result_t<C>>;

namespace detail {

/// The curvature at the origin of a frame of the quadric z = e x + f y + a x^2 + b x y + c y^2.
///
/// The curvatures are the eigenvalues of the shape operator S, in an orthonormal basis of the
/// quadric's own tangent plane: t1 along the gradient (e, f) and t2 orthogonal to it. They hold
/// also where that plane is inclined to the frame's x-y plane.
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
        result.trust = trust::degenerate;  // the neighborhood is so small that 1/radius overflows
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

/// Curvature by least squares of z = a x^2 + b xy + c y^2 + e x + f y + g over the neighbors and
/// the point, followed by the eigenvalues of the shape operator. The default.
///
/// The constant and the first-order terms absorb errors of the point and of its normal; the
/// thesis's form (`thesis_curvature`) has no such terms and requires both to be exact. See
/// docs/thesis-notes.md, A13.
///
/// Models `curvature_estimator`. Needs five neighbors. O(k), no heap memory.
///
/// The normal may have any length; the zero vector means that it is missing. Trust: `not_finite` if
/// the point, its normal or a neighbor is not finite; `degenerate` if the normal is missing, or if
/// neighbors and point do not determine the six coefficients (fewer than six distinct points, or
/// all on one conic: one or two scan lines, or a circle about the axis of a rotating scanner);
/// `weak` if the fit is ill-conditioned by either parameter below.
struct shape_operator_curvature {
    /// Aspect ratio sigma_ar of the neighborhood in the tangent plane, Eq. (3.19), below which the
    /// trust is `weak`.
    double min_aspect_ratio = 0.1;
    /// Tolerance below which the trust is `weak`: the smallest fraction of a column of the design
    /// matrix that the preceding columns do not explain, in [0, 1]. Its inverse is the variance
    /// inflation factor, by which noise in z is amplified.
    double min_independence = 1e-2;

    /// @param p          the point [m]
    /// @param normal     its normal, of any length
    /// @param neighbors  the positions of its neighbors [m], without the point
    [[nodiscard]] curvature operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       neighborhood_view neighbors) const {
        detail::height_frame frame(p, normal, neighbors, 5, min_aspect_ratio);
        curvature none;
        none.trust = frame.trust;
        if (!usable(frame.trust)) return none;
        detail::least_squares_quadric fit;
        fit.add(0.0, 0.0, 0.0);
        for (const Eigen::Vector3d& q : neighbors) {
            // Coordinates of root mean square 1 make the condition of the normal equations
            // independent of the size and the aspect ratio of the neighborhood.
            const auto [x, y, z] = frame(q);
            fit.add(x / frame.rms_x, y / frame.rms_y, z);
        }
        const double independence = fit.solve();
        constexpr double rounding = 1e-10;  // rounding error of D_j / A_jj, 1e-15, with a margin
        if (!(independence > rounding)) {
            none.trust = trust::degenerate;
            return none;
        }
        if (independence < min_independence) frame.trust = trust::weak;
        return detail::curvature_of(fit.solution(1.0 / frame.rms_x, 1.0 / frame.rms_y), frame);
    }
};

/// Curvature by the literal method of the thesis, Eqs. (3.25) to (3.27): the unit vector
/// [a' b' c' d'] that minimizes the sum of squares of a' x^2 + b' xy + c' y^2 + d' z over the
/// neighbors, in metres; a = -a'/d', b = -b'/d', c = -c'/d', K = 4ac - b^2, H = a + c. It assumes
/// that point and normal are exact. See docs/thesis-notes.md, A13.
///
/// Models `curvature_estimator`, but violates the law of scale: the unit vector mixes units [m^2]
/// and [m], so the fit depends on the unit of length unless all residuals are zero. Where the noise
/// of z exceeds the square of the neighborhood's width, the minimum is at the quadrics xy and x^2 -
/// y^2, and the method finds saddles everywhere, as in Fig. 3.14.
///
/// Needs three neighbors. O(k), no heap memory. The eigenvectors of R^T R give the singular vectors
/// of the matrix R of all rows, so the relative error is about 1e-16 (s_1 / s_3)^2 in singular
/// values of R.
///
/// Normal and trust: as for `shape_operator_curvature`; `degenerate` also if the smallest singular
/// value is double, or if d' is zero.
struct thesis_curvature {
    /// Aspect ratio sigma_ar of the neighborhood in the tangent plane, Eq. (3.19), below which the
    /// trust is `weak`.
    double min_aspect_ratio = 0.1;

    /// @param p          the point [m]
    /// @param normal     its normal, of any length
    /// @param neighbors  the positions of its neighbors [m], without the point
    [[nodiscard]] curvature operator()(const Eigen::Vector3d& p, const Eigen::Vector3d& normal,
                                       neighborhood_view neighbors) const {
        const detail::height_frame frame(p, normal, neighbors, 3, min_aspect_ratio);
        curvature none;
        none.trust = frame.trust;
        if (!usable(frame.trust)) return none;
        detail::homogeneous_quadric fit;
        for (const Eigen::Vector3d& q : neighbors) {
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
