// SPDX-License-Identifier: BSL-1.0
/// @file
/// The variances of a point set along its principal directions, and two shape features of them:
/// surface variation and aspect ratio. Both are ratios of singular values, as in the thesis; the
/// surface variation of Pauly et al. 2002 is a ratio of variances.
///
/// Klasing, Aspects of 3D Perception, Abstraction, and Interpretation in Autonomous Mobile
/// Robotics, TUM 2010, Eqs. (3.19) and (3.28). M. Pauly, M. Gross and L. Kobbelt, Efficient
/// simplification of point-sampled surfaces, 2002.
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon {

/// The variances [m^2] of a point set along its principal directions, largest first.
///
/// lambda_i = s_i^2 / m for the singular values s_i of the m x 3 matrix of centered points. For
/// coplanar points the smallest variance is zero up to rounding, about 1e-16 times the largest.
struct spectrum {
    Eigen::Vector3d lambda{0.0, 0.0, 0.0};  ///< variances [m^2], descending, at least 0

    spectrum() = default;
    /// @param variances  eigenvalues of a covariance [m^2], descending; negative ones, which
    ///                   rounding leaves, are set to zero
    explicit spectrum(const Eigen::Vector3d& variances) : lambda(variances) {
        for (int i = 0; i < 3; ++i) lambda[i] = std::max(lambda[i], 0.0);
    }

    /// The standard deviations [m], proportional to the singular values s_1 >= s_2 >= s_3.
    [[nodiscard]] Eigen::Vector3d deviations() const {
        return {std::sqrt(lambda[0]), std::sqrt(lambda[1]), std::sqrt(lambda[2])};
    }

    /// The surface variation sigma_sv = 3 s_3 / (s_1 + s_2 + s_3) in [0, 1], Eq. (3.28): 0 for a
    /// plane, 1 for a ball, and 0 if all points coincide.
    [[nodiscard]] double surface_variation() const {
        const Eigen::Vector3d s = deviations();
        return s[0] > 0.0 ? 3.0 * s[2] / (s[0] + s[1] + s[2]) : 0.0;
    }

    /// The surface variation sigma_n = lambda_3 / (lambda_1 + lambda_2 + lambda_3) of Pauly et al.
    /// 2002 in [0, 1/3]: 0 for a plane, 1/3 for a ball, and 0 if all points coincide. PCL calls it
    /// curvature.
    [[nodiscard]] double pauly_variation() const {
        if (!(lambda[0] > 0.0)) return 0.0;
        const double r2 = lambda[1] / lambda[0];  // ratios first: the sum may overflow
        const double r3 = lambda[2] / lambda[0];
        return r3 / (1.0 + r2 + r3);
    }

    /// The aspect ratio sigma_ar = s_2 / s_1 in [0, 1], Eq. (3.19): near 0 if all points lie on one
    /// scan line, and 0 if all points coincide.
    [[nodiscard]] double aspect_ratio() const {
        return lambda[0] > 0.0 ? std::sqrt(lambda[1] / lambda[0]) : 0.0;
    }

    /// Converts a threshold on Pauly's surface variation sigma_n to one on sigma_sv, Eq. (3.28).
    ///
    /// The two are not functions of each other: the conversion depends on the aspect ratio sigma_ar
    /// of the points, so a converted threshold is exact for neighborhoods of one aspect ratio only,
    /// by default 1. With aspect ratio 1, sigma_n = 0.0055 corresponds to sigma_sv = 0.15. See
    /// docs/thesis-notes.md, A34.
    /// @param sigma_n   Pauly's surface variation in [0, 1/3]
    /// @param sigma_ar  aspect ratio s_2 / s_1 in [0, 1]
    /// @return          sigma_sv, in [0, 1] where s_3 <= s_2:
    ///                  sigma_n <= sigma_ar^2 / (1 + 2 sigma_ar^2)
    [[nodiscard]] static double surface_variation_from_pauly(double sigma_n,
                                                             double sigma_ar = 1.0) {
        const double r =  // s_3 / s_1
            std::sqrt(sigma_n * (1.0 + sigma_ar * sigma_ar) / (1.0 - sigma_n));
        return 3.0 * r / (1.0 + sigma_ar + r);
    }
};

}  // namespace gnomon
