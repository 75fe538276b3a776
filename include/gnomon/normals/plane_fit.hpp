// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a total least squares fit of a plane tells: the direction in which a set of points varies
/// least, and how it spreads. The result of all estimators that decompose a 3x3 matrix.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/separated_eigen.hpp>
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

/// The same of n matrices, the i-th of which covariance_of(i) gives.
void planes_of_least_spread(std::size_t n, auto&& covariance_of, double min_aspect_ratio,
                            std::span<plane_fit> fits) {
    for (std::size_t first = 0; first < n; first += pack_size) {
        const std::size_t many = std::min(pack_size, n - first);
        std::array<Eigen::Matrix3d, pack_size> matrices;
        std::array<double, pack_size> traces{};
        symmetric_3x3<pack> packed{};
        for (std::size_t l = 0; l < many; ++l) {
            const Eigen::Matrix3d& m = matrices[l] = covariance_of(first + l);
            traces[l] = m(0, 0) + m(1, 1) + m(2, 2);
            const double s = has_scale(traces[l]) ? 1.0 / traces[l] : 0.0;
            const auto at = static_cast<Eigen::Index>(l);
            packed.xx[at] = s * m(0, 0);
            packed.yy[at] = s * m(1, 1);
            packed.zz[at] = s * m(2, 2);
            packed.xy[at] = s * m(1, 0);
            packed.xz[at] = s * m(2, 0);
            packed.yz[at] = s * m(2, 1);
        }
        for (auto at = static_cast<Eigen::Index>(many); at < pack::SizeAtCompileTime; ++at) {
            packed.xx[at] = packed.yy[at] = 0.5;
            packed.zz[at] = packed.xy[at] = packed.xz[at] = packed.yz[at] = 0.0;
        }
        const separated_eigen<pack> found(packed);
        for (std::size_t l = 0; l < many; ++l) {
            const auto at = static_cast<Eigen::Index>(l);
            if (!has_scale(traces[l]) || !is_accurate(found.values[1][at], found.values[2][at],
                                                      found.squared_residual[at])) {
                fits[first + l] = plane_of_least_spread(matrices[l], min_aspect_ratio);
                continue;
            }
            eigen_decomposition e;
            for (int i = 0; i < 3; ++i) {
                e.values[i] = traces[l] * found.values[i][at];
                e.vectors(0, i) = found.vectors[i].x[at];
                e.vectors(1, i) = found.vectors[i].y[at];
                e.vectors(2, i) = found.vectors[i].z[at];
            }
            fits[first + l] = plane_across(e, min_aspect_ratio);
        }
    }
}

}  // namespace detail
}  // namespace gnomon
