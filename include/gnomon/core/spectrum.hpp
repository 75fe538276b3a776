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
#include <cmath>

#include <Eigen/Core>

namespace gnomon {

/// The variances [m^2] of a point set along its principal directions, largest first.
/// lambda_i = s_i^2 / m for the singular values s_i of the m x 3 matrix of centered points; for
/// exactly planar sets the smallest is zero up to rounding of about 1e-16 times the largest.
struct spectrum {
    Eigen::Vector3d lambda = Eigen::Vector3d::Zero();

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

    /// sigma_ar = s_2 / s_1, Eq. (3.19): near 0 where all points lie on one scan line; 0 for a
    /// single place.
    [[nodiscard]] double aspect_ratio() const {
        return lambda[0] > 0.0 ? std::sqrt(lambda[1] / lambda[0]) : 0.0;
    }
};

}  // namespace gnomon
