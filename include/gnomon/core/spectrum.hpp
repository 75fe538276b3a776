// SPDX-License-Identifier: BSL-1.0
/// @file
/// How a set of points spreads along its three principal directions, and what that tells of its
/// shape: surface variation and aspect ratio, from singular values as in the thesis (and not from
/// variances as in Pauly et al. 2002).
///
/// Klasing, Aspects of 3D Perception, Abstraction, and Interpretation in Autonomous Mobile
/// Robotics, TUM 2010, Eqs. (3.19) and (3.28).
#pragma once

#include <algorithm>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>

namespace gnomon {

/// The variances [m^2] of a point set along its principal directions, largest first.
/// lambda_i = s_i^2 / m for the singular values s_i of the m x 3 matrix of centered points; for
/// exactly planar sets the smallest is zero up to rounding of about 1e-16 times the largest.
struct spectrum {
    Eigen::Vector3d lambda{0.0, 0.0, 0.0};

    spectrum() = default;
    /// Clamps what rounding made negative.
    explicit spectrum(const Eigen::Vector3d& variances) : lambda(variances) {
        for (int i = 0; i < 3; ++i) lambda[i] = std::max(lambda[i], 0.0);
    }

    /// The standard deviations [m], proportional to the singular values s_1 >= s_2 >= s_3.
    [[nodiscard]] Eigen::Vector3d deviations() const {
        return {std::sqrt(lambda[0]), std::sqrt(lambda[1]), std::sqrt(lambda[2])};
    }

    /// sigma_sv = 3 s_3 / (s_1 + s_2 + s_3), Eq. (3.28): 0 for a plane, 1 for a ball; 0 for a
    /// single place.
    [[nodiscard]] double surface_variation() const {
        const Eigen::Vector3d s = deviations();
        return s[0] > 0.0 ? 3.0 * s[2] / (s[0] + s[1] + s[2]) : 0.0;
    }

    /// sigma_n = lambda_3 / (lambda_1 + lambda_2 + lambda_3), the surface variation of Pauly et al.
    /// 2002, from variances: 0 for a plane, 1/3 for a ball; 0 for a single place.
    [[nodiscard]] double pauly_variation() const {
        if (!(lambda[0] > 0.0)) return 0.0;
        const double r2 = lambda[1] / lambda[0];  // ratios first: the sum may overflow
        const double r3 = lambda[2] / lambda[0];
        return r3 / (1.0 + r2 + r3);
    }

    /// sigma_ar = s_2 / s_1, Eq. (3.19): near 0 where all points lie on one scan line; 0 for a
    /// single place.
    [[nodiscard]] double aspect_ratio() const {
        return lambda[0] > 0.0 ? std::sqrt(lambda[1] / lambda[0]) : 0.0;
    }
};

/// The surface variation sigma_sv of Eq. (3.28) that points of Pauly's variation sigma_n have, to
/// carry thresholds over (specification A34). That depends on the aspect ratio sigma_ar = s_2 / s_1
/// of the points, so a threshold holds for neighborhoods of one shape only, round ones by default.
/// @param sigma_n   in [0, 1/3]
/// @param sigma_ar  in [0, 1]
[[nodiscard]] inline double surface_variation_from_pauly(double sigma_n, double sigma_ar = 1.0) {
    const double r = std::sqrt(sigma_n * (1.0 + sigma_ar * sigma_ar) / (1.0 - sigma_n));  // s3 / s1
    return 3.0 * r / (1.0 + sigma_ar + r);
}

/// The inverse: Pauly's variation of points of surface variation `sigma_sv`, in [0, 1]. A threshold
/// of 0.15 is one of 0.0055.
[[nodiscard]] constexpr double pauly_from_surface_variation(double sigma_sv,
                                                            double sigma_ar = 1.0) {
    const double r = sigma_sv * (1.0 + sigma_ar) / (3.0 - sigma_sv);  // s_3 / s_1
    return r * r / (1.0 + sigma_ar * sigma_ar + r * r);
}

}  // namespace gnomon
