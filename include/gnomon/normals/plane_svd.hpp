// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlaneSVD: the plane n . x + d = 0 whose four coefficients, as a unit vector, are most nearly
/// orthogonal to the points (x, 1).
///
/// A unit *four*-vector weighs metres against a number, so the result depends on the unit and on
/// the origin. In the sensor's frame and in metres, as the thesis has it, it leans the normal
/// towards the line of sight. Under noise along the rays this happens to help, and it is why
/// PlaneSVD comes out ahead of PlanePCA on simulated scans; it is a prior, not information.
///
/// Klasing 2010, Eq. (3.1), which forgets the column of ones in the matrix of its text.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/square_array.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// Models `ray_estimator`: the origin of its frame is the view point. Needs two neighbors. O(k).
///
/// Trust: `degenerate` where the plane is not determined; more than some 1e5 neighborhood radii
/// from the view point that is always so.
struct plane_svd {
    static constexpr auto sensitive_to = sensitivity::units;

    /// Constrains only the normal to unit length, which makes it PlanePCA, anywhere and in any
    /// unit.
    bool centred = false;

    [[nodiscard]] normal_fit operator()(const Eigen::Vector3d& p, ring_view ring,
                                        const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        if (ring.size() < 2) return {};
        if (centred) return plane_pca{}(p, ring);

        square_array<4> m = {};  // [Q+ 1]^T [Q+ 1]
        const auto add = [&m, &viewpoint](const Eigen::Vector3d& q) {
            const double row[4] = {q[0] - viewpoint[0], q[1] - viewpoint[1], q[2] - viewpoint[2],
                                   1.0};
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = 0; j < 4; ++j) m[i][j] += row[i] * row[j];
            }
        };
        add(p);
        for (const Eigen::Vector3d& q : ring) add(q);

        normal_fit fit;
        fit.trust = trust::not_finite;
        if (!std::isfinite(m[0][0] + m[1][1] + m[2][2])) return fit;
        const auto e = symmetric_eigen<4>(m);
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
