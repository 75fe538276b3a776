// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlanePCA: the normal is the direction in which a point and its neighbors vary least, the total
/// least squares plane. The method of choice throughout the thesis.
///
/// Klasing, Aspects of 3D Perception, Abstraction, and Interpretation in Autonomous Mobile
/// Robotics, TUM 2010, Eq. (3.2) and Alg. 3.1; Hoppe et al. 1992.
#pragma once

#include <cmath>

#include <Eigen/Core>

#include <gnomon/core/moments.hpp>
#include <gnomon/core/spectrum.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// A plane fitted to a neighborhood, and how the neighborhood spreads.
struct plane_fit {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit length, or zero if not usable
    gnomon::trust trust = gnomon::trust::too_few_neighbors;
    gnomon::spectrum spectrum;  ///< of the neighbors and the point [m^2]

    [[nodiscard]] double surface_variation() const { return spectrum.surface_variation(); }
    [[nodiscard]] double aspect_ratio() const { return spectrum.aspect_ratio(); }
};

/// Models `estimator`. Needs two neighbors. O(k).
///
/// Trust: `weak` where the aspect ratio is under `min_aspect_ratio` (a neighborhood from one scan
/// line); `degenerate` where the normal is not determined: all points at one place, on one line, or
/// spread alike in two directions across the largest.
struct plane_pca {
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak, Sec. 3.2.9

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p, ring_view ring) const {
        moments m;
        for (const Eigen::Vector3d& q : ring) m.add(q - p);
        return (*this)(m);
    }

    /// The fit from the moments of the neighbors about the point.
    [[nodiscard]] plane_fit operator()(const moments& m) const {
        plane_fit fit;
        if (m.count < 2) return fit;
        const Eigen::Matrix3d covariance = m.covariance_with_point();  // Eq. (3.5)
        // The trace is a sum of squares: whatever is not finite shows in it.
        if (!std::isfinite(covariance(0, 0) + covariance(1, 1) + covariance(2, 2))) {
            fit.trust = gnomon::trust::not_finite;
            return fit;
        }
        const eigen_decomposition e = symmetric_eigen(covariance);
        fit.spectrum = spectrum(e.values);
        // The normal errs by about 1e-15 / gap: at this gap it is noise.
        constexpr double smallest_gap = 1e-12;
        if (e.values[1] - e.values[2] <= smallest_gap * e.values[0]) {
            fit.trust = gnomon::trust::degenerate;
            return fit;
        }
        fit.normal = e.vectors.col(2);
        fit.trust =
            fit.aspect_ratio() < min_aspect_ratio ? gnomon::trust::weak : gnomon::trust::good;
        return fit;
    }
};

}  // namespace gnomon
