// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlaneSVD: the plane n . x + d = 0 whose coefficients (n, d), of unit length as a 4-vector,
/// minimize the sum of squares of n . x + d over the points.
///
/// The length of the 4-vector adds coordinates in metres to a number, so that the result depends on
/// the unit and on the origin. In metres and in the frame of the sensor, as in the thesis, the
/// normal is biased towards the ray. With noise along the rays this bias reduces the error, which
/// is why PlaneSVD has smaller errors than PlanePCA on simulated scans.
///
/// Klasing 2010, Eq. (3.1); the matrix in the text there lacks the column of ones.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/jacobi_eigen.hpp>
#include <gnomon/core/detail/square_array.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// Models `ray_estimator`: the origin of its frame is the view point. Needs two neighbors. O(k).
///
/// Trust: `degenerate` where the plane is not determined: always, where the view point is farther
/// away than some 1e5 radii of the neighborhood.
struct plane_svd {
    static constexpr auto sensitive_to = sensitivity::units;

    /// Constrains the length of n instead of that of (n, d). The result is that of PlanePCA, which
    /// depends on neither unit nor origin.
    bool centred = false;

    [[nodiscard]] normal_fit operator()(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                        const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        if (neighbors.size() < 2) return {};
        if (centred) return plane_pca{}(p, neighbors);

        detail::square_array<4> m = {};  // [Q+ 1]^T [Q+ 1]
        const auto add = [&m, &viewpoint](const Eigen::Vector3d& q) {
            const double row[4] = {q[0] - viewpoint[0], q[1] - viewpoint[1], q[2] - viewpoint[2],
                                   1.0};
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < 4; ++j) m[i][j] += row[i] * row[j];
            }
        };
        add(p);
        for (const Eigen::Vector3d& q : neighbors) add(q);

        normal_fit fit;
        fit.trust = trust::not_finite;
        if (!std::isfinite(m[0][0] + m[1][1] + m[2][2])) return fit;
        const auto e = detail::jacobi_eigen<4>(m);
        const Eigen::Vector3d n(e.vectors[0][3], e.vectors[1][3], e.vectors[2][3]);
        const double length = detail::length(n);
        fit.trust = trust::degenerate;
        if (e.values[2] - e.values[3] <= detail::smallest_gap * e.values[0] || length == 0.0) {
            return fit;
        }
        fit.normal = detail::scaled(1.0 / length, n);
        fit.trust = trust::good;
        return fit;
    }
};

}  // namespace gnomon
