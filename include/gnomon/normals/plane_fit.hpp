// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a total least squares fit of a plane tells: the direction in which a set of points varies
/// least, and how it spreads. The result of all estimators that decompose a 3x3 matrix.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/spectrum.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// A plane fitted to a neighborhood, and how the neighborhood spreads.
struct plane_fit : normal_fit {
    gnomon::spectrum spectrum;  ///< of what was fitted [m^2]

    [[nodiscard]] double surface_variation() const { return spectrum.surface_variation(); }
    [[nodiscard]] double aspect_ratio() const { return spectrum.aspect_ratio(); }
};

namespace detail {

/// Eigenvectors err by about 1e-15 / gap: below this gap, relative to the largest eigenvalue, a
/// normal is noise.
inline constexpr double smallest_gap = 1e-12;

/// The plane across the direction of least spread, from the eigenvectors of a neighborhood's second
/// moments [m^2]: degenerate where that is not determined, weak under the given aspect ratio.
[[nodiscard]] inline plane_fit plane_across(const eigen_decomposition& e, double min_aspect_ratio) {
    plane_fit fit;
    fit.spectrum = gnomon::spectrum(e.values);
    if (e.values[1] - e.values[2] <= smallest_gap * e.values[0]) {
        fit.trust = trust::degenerate;
        return fit;
    }
    fit.normal = e.vectors.col(2);
    fit.trust = fit.aspect_ratio() < min_aspect_ratio ? trust::weak : trust::good;
    return fit;
}

/// The same from the second moments themselves.
[[nodiscard]] inline plane_fit plane_of_least_spread(const Eigen::Matrix3d& second_moments,
                                                     double min_aspect_ratio) {
    if (has_finite_trace(second_moments))
        return plane_across(symmetric_eigen(second_moments), min_aspect_ratio);
    plane_fit fit;
    fit.trust = trust::not_finite;
    return fit;
}

}  // namespace detail
}  // namespace gnomon
