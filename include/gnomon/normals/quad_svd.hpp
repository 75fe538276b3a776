// SPDX-License-Identifier: BSL-1.0
/// @file
/// QuadSVD: a quadric through the neighbors, S(x) = c . (x^2 y^2 z^2 xy xz yz x y z 1) = 0 with
/// |c| = 1; the normal is its gradient at the point.
///
/// Exact on spheres, cylinders, cones and paraboloids of any curvature. On noisy planes it is
/// inaccurate: every pair of planes that contains the plane is a quadric through the points, and
/// noise determines which of them fits best.
///
/// Klasing 2010, Eq. (3.7); the gradient is not in the text.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/small_svd.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/plane_pca.hpp>

namespace gnomon {

/// Models `ray_estimator`: the origin of its frame is the view point. Needs nine neighbors. O(k),
/// with a large constant: the singular value decomposition of a 10 x 10 triangle.
///
/// Trust: `weak`, and the normal that of PlanePCA, where more than one quadric passes through all
/// neighbors (on a perfect plane, for instance) or the gradient vanishes.
struct quad_svd {
    static constexpr auto sensitive_to = sensitivity::units | sensitivity::axes;

    /// Moves the origin to the point and scales the mean squared distance to its neighbors to one,
    /// so that the result depends on neither unit nor view point. The thesis does neither.
    bool centred = false;

    [[nodiscard]] normal_fit operator()(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                        const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        normal_fit fit;
        if (neighbors.size() < 9) return fit;
        const Eigen::Vector3d origin = centred ? p : viewpoint;
        const double scale = centred ? inverse_rms_distance(p, neighbors) : 1.0;

        detail::row_triangle<10> rows;
        for (const Eigen::Vector3d& q : neighbors) {
            const double x = scale * (q.x() - origin.x());
            const double y = scale * (q.y() - origin.y());
            const double z = scale * (q.z() - origin.z());
            rows.add({x * x, y * y, z * z, x * y, x * z, y * z, x, y, z, 1.0});
        }
        double sum = 0.0;
        for (const auto& row : rows.matrix()) {
            for (const double entry : row) sum += entry;
        }
        if (!std::isfinite(sum)) {
            fit.trust = trust::not_finite;
            return fit;
        }
        const auto svd = detail::small_svd<10>(rows.matrix());

        const auto c = [&svd](std::size_t i) { return svd.right[i][9]; };
        const double x = scale * (p.x() - origin.x());
        const double y = scale * (p.y() - origin.y());
        const double z = scale * (p.z() - origin.z());
        const Eigen::Vector3d gradient(2 * c(0) * x + c(3) * y + c(4) * z + c(6),
                                       2 * c(1) * y + c(3) * x + c(5) * z + c(7),
                                       2 * c(2) * z + c(4) * x + c(5) * y + c(8));
        const double length = detail::length(gradient);
        constexpr double negligible = 1e-12;
        if (svd.values[8] - svd.values[9] <= negligible * svd.values[0] ||
            length <= negligible * (1.0 + std::abs(x) + std::abs(y) + std::abs(z))) {
            const plane_fit plane = plane_pca{}(p, neighbors);
            fit.normal = plane.normal;
            fit.trust = usable(plane.trust) ? trust::weak : plane.trust;
            return fit;
        }
        fit.normal = detail::scaled(1.0 / length, gradient);
        fit.trust = trust::good;
        return fit;
    }

  private:
    static double inverse_rms_distance(const Eigen::Vector3d& p, neighborhood_view neighbors) {
        double square = 0.0;
        for (const Eigen::Vector3d& q : neighbors) square += squared_distance(p, q);
        return square > 0.0 ? std::sqrt(static_cast<double>(neighbors.size()) / square) : 1.0;
    }
};

}  // namespace gnomon
