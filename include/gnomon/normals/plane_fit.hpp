// SPDX-License-Identifier: BSL-1.0
/// @file
/// The result of a total least squares fit of a plane: its normal, the direction of least variance,
/// and the variances of the points along all three principal directions. All estimators that
/// decompose a 3x3 matrix return it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/pack.hpp>
#include <gnomon/core/detail/separated_eigen.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/spectrum.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The normal of a plane fitted to a neighborhood, and the spectrum of the neighborhood.
struct plane_fit : normal_fit {
    gnomon::spectrum spectrum;  ///< the variances along the principal directions [m^2]

    /// 3 s_3 / (s_1 + s_2 + s_3), Eq. (3.28): 0 for a plane, 1 for a ball.
    [[nodiscard]] double surface_variation() const { return spectrum.surface_variation(); }
    /// s_2 / s_1, Eq. (3.19): near 0 for points on one scan line.
    [[nodiscard]] double aspect_ratio() const { return spectrum.aspect_ratio(); }
};

namespace detail {

/// The smallest gap between the two smaller eigenvalues, relative to the largest, that determines a
/// normal: the rounding error of eigenvectors is about 1e-15 / gap [rad].
inline constexpr double smallest_gap = 1e-12;

/// The plane whose normal is the direction of least variance, from the eigenvectors of the second
/// moments of a neighborhood [m^2]: degenerate where that direction is not determined, weak below
/// the given aspect ratio.
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

/// The same plane from the second moments themselves. (Not inline, as estimators call it in several
/// places: for compile time only.)
[[nodiscard, GNOMON_NOINLINE]] inline plane_fit plane_of_least_spread(
    const Eigen::Matrix3d& second_moments, double min_aspect_ratio) {
    if (has_finite_trace(second_moments))
        return plane_across(symmetric_eigen(second_moments), min_aspect_ratio);
    plane_fit fit;
    fit.trust = trust::not_finite;
    return fit;
}

/// The same planes for n matrices; covariance_of(i) returns matrix i. Decomposes several matrices
/// at once.
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
