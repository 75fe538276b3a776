// SPDX-License-Identifier: BSL-1.0
/// @file
/// QuadTransSVD: a height function over the tangent plane, z = c1 x^2 + c2 y^2 + c3 xy + c4 x +
/// c5 y + c6, in the frame of VectorSVD at the point; the normal is that of the surface there.
///
/// The thesis keeps only the r = 3 largest singular values of the system. In metres these belong to
/// 1, x and y, so that the quadratic terms have almost no effect and the result is close to a plane
/// fitted in the rotated frame. The figures of the thesis are reproduced with r = 3; `rank = 6` is
/// the full fit.
///
/// Klasing 2010, Eq. (3.8).
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/small_svd.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon {

/// Models `estimator`. Needs five neighbors. O(k), with a large constant. The spectrum and the
/// trust are those of `vector_svd`; `weak` as well where there is no gap between the kept singular
/// values and the others: the normal is then that of `vector_svd`.
struct quad_trans_svd {
    static constexpr auto sensitive_to = sensitivity::units;

    /// The number of singular values that are used, 1 to 6. Singular values below 1e-12 of the
    /// largest are never used, so that 6 is the numerical rank.
    int rank = 3;
    double min_aspect_ratio = 0.1;  ///< sigma_ar below which the normal is weak

    [[nodiscard]] plane_fit operator()(const Eigen::Vector3d& p,
                                       neighborhood_view neighbors) const {
        detail::require(rank >= 1 && rank <= 6, "quad_trans_svd: the rank must be 1 to 6");
        if (neighbors.size() < 5) return {};
        const Eigen::Matrix3d second_moments = moments::about(p, neighbors).second_moments();
        plane_fit fit;
        fit.trust = trust::not_finite;
        if (!detail::has_finite_trace(second_moments)) return fit;
        const detail::eigen_decomposition e = detail::symmetric_eigen(second_moments);  // VectorSVD
        fit = detail::plane_across(e, min_aspect_ratio);
        if (!usable(fit.trust)) return fit;
        const Eigen::Vector3d e1 = detail::column(e.vectors, 0);
        const Eigen::Vector3d e2 = detail::column(e.vectors, 1);
        const Eigen::Vector3d e3 = detail::column(e.vectors, 2);

        detail::row_triangle<7> rows;  // the unknowns' six columns, and the heights
        for (const Eigen::Vector3d& q : neighbors) {
            const Eigen::Vector3d d = detail::difference(q, p);
            const double x = detail::dot(d, e1);
            const double y = detail::dot(d, e2);
            rows.add({x * x, y * y, x * y, x, y, 1.0, detail::dot(d, e3)});
        }
        detail::square_array<6> r;
        for (std::size_t j = 0; j < 6; ++j) {
            for (std::size_t i = 0; i < 6; ++i) r[i][j] = rows.matrix()[i][j];
        }
        const auto svd = detail::small_svd<6>(r);
        constexpr double negligible = 1e-12;
        const auto kept = static_cast<std::size_t>(rank);
        if (kept < 6 && svd.values[kept - 1] - svd.values[kept] <= negligible * svd.values[0]) {
            fit.trust = trust::weak;
            return fit;
        }
        double c4 = 0.0;
        double c5 = 0.0;
        for (std::size_t j = 0; j < kept && svd.values[j] > negligible * svd.values[0]; ++j) {
            double projection = 0.0;  // <u_j, z> s_j
            for (std::size_t i = 0; i < 6; ++i)
                projection += svd.scaled_left[i][j] * rows.matrix()[i][6];
            const double share = projection / (svd.values[j] * svd.values[j]);
            c4 += share * svd.right[3][j];
            c5 += share * svd.right[4][j];
        }
        const Eigen::Vector3d n = detail::combined(1.0, e3, -c4, e1, -c5, e2);
        fit.normal = detail::scaled(1.0 / detail::length(n), n);
        return fit;
    }
};

}  // namespace gnomon
