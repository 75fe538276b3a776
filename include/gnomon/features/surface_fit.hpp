// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the fits of spheres, cylinders and cones have in common: their outcome, and the test of
/// whether the surface explains the points.
///
/// Where the view point of a point is known, its residual is the difference of the measured range
/// and that of the surface along the same ray, divided by the standard deviation of the range. Rays
/// that do not meet the surface, or at a cosine below 0.2 to its normal, are left out; after two
/// rounds, when the surface is nearly known, only rays below 0.1 are, and none returns. Where the
/// view point is unknown, noise is the same in all directions, and the residual is the orthogonal
/// distance divided by its deviation. On a curved surface such noise displaces the mean distance by
/// sigma^2 / 2 times the sum of the principal curvatures; this is subtracted, with the smaller of
/// the stated variance and that of the residuals. The sum of squared residuals is minimized by the
/// method of Levenberg and Marquardt (Marquardt 1963).
///
/// To the variance of the noise is added that of the rounding of the coordinates. Unevenness of the
/// surface itself is stated as noise: `noise.plus(0.002)`.
///
/// Covariances are of first order. In 2,000 draws of 200 points, on arcs of 90 to 360 degrees, mean
/// squared errors are within 10 % of them up to noise of .05 radii, except for cones of 90 degrees,
/// where that holds up to .01 radii; at .05 radii their covariances are too small by a fourth.
/// Without noise, parameters are exact to the rounding of the coordinates.
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

namespace gnomon {

/// The outcome of a least-squares fit. Base of `sphere_estimate`, `cylinder_estimate` and
/// `cone_estimate`.
struct surface_fit {
    /// What a fit can come to.
    enum class outcome : std::uint8_t {
        good,           ///< the surface explains the points
        poor_fit,       ///< it does not: noise has this chi-square in .3 % of cases
        not_converged,  ///< the parameters are those of the last iteration
        /// No more points than parameters: fewer than these and one more are finite, or remain when
        /// rays that do not meet the surface well are left out.
        too_few_points,
        /// The points do not determine the parameters: they are coplanar, collinear or one place,
        /// or flat within their noise. The test: the standard deviation of a parameter is 0.34
        /// radii (sphere), 0.29 (cylinder), 0.27 (cone) or more, or as many radians. Fewer than 1 %
        /// of noisy planes pass.
        degenerate
    };

    outcome status = outcome::too_few_points;  ///< of this fit
    /// Whose residuals are in the fit; the finite points if it was not tried, for the points are
    /// too few or have no volume.
    std::size_t points = 0;
    std::size_t degrees_of_freedom = 0;  ///< points less parameters
    /// The sum of squared residuals, in variances of the noise: about `degrees_of_freedom`. It is a
    /// sum, and `plane_estimate::chi2` a mean.
    double chi_square = 0.0;
    double rms = 0.0;  ///< root mean square orthogonal distance of all finite points [m]

    /// Whether there are parameters: the fit is good or poor, or not converged.
    [[nodiscard]] bool has_parameters() const { return status <= outcome::not_converged; }
};

/// The name of an outcome, for tables and messages.
[[nodiscard]] constexpr const char* to_string(surface_fit::outcome o) {
    switch (o) {
        case surface_fit::outcome::good:
            return "good";
        case surface_fit::outcome::poor_fit:
            return "poor_fit";
        case surface_fit::outcome::not_converged:
            return "not_converged";
        case surface_fit::outcome::too_few_points:
            return "too_few_points";
        case surface_fit::outcome::degenerate:
            return "degenerate";
    }
    return "unknown";
}

namespace detail {

/// A covariance of N parameters. Not aligned for vector instructions, on which the layout of
/// structs would depend.
template <int N>
using parameter_covariance = Eigen::Matrix<double, N, N, Eigen::DontAlign>;

}  // namespace detail
}  // namespace gnomon
