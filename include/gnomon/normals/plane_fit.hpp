// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a total least squares fit of a plane tells: the direction in which a set of points varies
/// least, and how it spreads. The result of all estimators that decompose a 3x3 matrix.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/separated_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
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
    fit.normal = detail::column(e.vectors, 2);
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

/// The same of n matrices, the i-th of which covariance_of(i) gives.
void planes_of_least_spread(std::size_t n, auto&& covariance_of, double min_aspect_ratio,
                            std::span<plane_fit> fits) {
    for (std::size_t first = 0; first < n; first += pack::size) {
        const std::size_t many = std::min(pack::size, n - first);
        std::array<Eigen::Matrix3d, pack::size> matrices;
        std::array<double, pack::size> traces{};
        std::array<std::array<double, pack::size>, 6> entries{};
        for (std::size_t l = 0; l < pack::size; ++l) entries[0][l] = entries[1][l] = 0.5;
        for (std::size_t l = 0; l < many; ++l) {
            const Eigen::Matrix3d& m = matrices[l] = covariance_of(first + l);
            traces[l] = m(0, 0) + m(1, 1) + m(2, 2);
            const double s = has_scale(traces[l]) ? 1.0 / traces[l] : 0.0;
            entries[0][l] = s * m(0, 0);
            entries[1][l] = s * m(1, 1);
            entries[2][l] = s * m(2, 2);
            entries[3][l] = s * m(1, 0);
            entries[4][l] = s * m(2, 0);
            entries[5][l] = s * m(2, 1);
        }
        const auto packed = [&](std::size_t e) { return pack(entries[e].data()); };
        const separated_eigen<pack> found(
            symmetric_3x3<pack>{packed(0), packed(1), packed(2), packed(3), packed(4), packed(5)});
        for (std::size_t l = 0; l < many; ++l) {
            if (!has_scale(traces[l]) ||
                !is_accurate(found.values[1][l], found.values[2][l], found.squared_residual[l])) {
                fits[first + l] = plane_of_least_spread(matrices[l], min_aspect_ratio);
                continue;
            }
            eigen_decomposition e;
            for (int i = 0; i < 3; ++i) {
                e.values[i] = traces[l] * found.values[i][l];
                e.vectors(0, i) = found.vectors[i].x[l];
                e.vectors(1, i) = found.vectors[i].y[l];
                e.vectors(2, i) = found.vectors[i].z[l];
            }
            fits[first + l] = plane_across(e, min_aspect_ratio);
        }
    }
}

}  // namespace detail
}  // namespace gnomon
