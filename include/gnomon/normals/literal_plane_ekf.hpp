// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlaneEKF line by line as in the thesis, for the record: the state is a 3-vector of any length,
/// it starts anywhere, and passing the data again counts them again. Some starts never come round,
/// and the covariance promises far too much; `plane_ekf` is the filter to use.
///
/// Klasing 2010, Sec. 3.2.7, Alg. 3.2, Eqs. (3.16)-(3.18).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <gnomon/core/moments.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>

namespace gnomon {

/// h(x) of Eq. (3.17): the range [m] at which the unit ray u meets the plane through `centroid` [m]
/// with the normal x of any length.
[[nodiscard]] inline double predicted_range(const Eigen::Vector3d& centroid,
                                            const Eigen::Vector3d& x, const Eigen::Vector3d& u) {
    return centroid.dot(x) / u.dot(x);
}

/// dh/dx of Eq. (3.18).
[[nodiscard]] inline Eigen::Vector3d range_jacobian(const Eigen::Vector3d& centroid,
                                                    const Eigen::Vector3d& x,
                                                    const Eigen::Vector3d& u) {
    const double ux = u.dot(x);
    return (ux * centroid - centroid.dot(x) * u) / (ux * ux);
}

/// Models `ray_estimator`. Needs two neighbors. O(passes k). The covariance is that of the
/// algorithm, made one of the unit normal.
struct literal_plane_ekf {
    static constexpr auto sensitive_to = sensitivity::order | sensitivity::units | sensitivity::axes;

    double sigma = 0.015;          ///< standard deviation of the range [m]
    int passes = 5;                ///< over all points
    double prior_variance = 10.0;  ///< Sigma_0 = 10 I
    std::uint64_t seed = 1;        ///< of the random start x_0

    /// @throws std::invalid_argument  unless sigma is positive and finite
    [[nodiscard]] normal_belief operator()(
        const Eigen::Vector3d& p, ring_view ring,
        const Eigen::Vector3d& viewpoint = Eigen::Vector3d::Zero()) const {
        detail::require_sigma(sigma);
        normal_belief belief;
        if (ring.size() < 2) return belief;

        random_stream random(seed);
        Eigen::Vector3d x;  // line 1
        for (int a = 0; a < 3; ++a) x[a] = random.gaussian();
        x /= x.norm();
        Eigen::Matrix3d covariance = prior_variance * Eigen::Matrix3d::Identity();
        const moments m = moments_about(p, ring);
        const Eigen::Vector3d centroid =
            p - viewpoint + m.mean_with_point();  // line 2
        const auto take_in = [&](const Eigen::Vector3d& q) {
            const double range = q.norm();
            const Eigen::Vector3d u = q / range;                            // line 4
            const double h = predicted_range(centroid, x, u);               // line 5
            const Eigen::Vector3d jacobian = range_jacobian(centroid, x, u);  // line 6
            const Eigen::Vector3d ph = covariance * jacobian;
            const Eigen::Vector3d gain = ph / (jacobian.dot(ph) + sigma * sigma);  // line 7
            x += (range - h) * gain;                                               // line 8
            covariance -= gain * ph.transpose();                                   // line 9
        };
        for (int pass = 0; pass < passes; ++pass) {
            take_in(p - viewpoint);
            for (const Eigen::Vector3d& q : ring) take_in(q - viewpoint);
        }

        const double length = x.norm();
        belief.trust = trust::not_finite;
        if (!std::isfinite(length) || !covariance.allFinite()) return belief;
        belief.trust = trust::degenerate;
        if (length == 0.0) return belief;
        belief.normal = x / length;
        const detail::tangent_frame frame(belief.normal);
        const Eigen::Vector3d c1 = covariance * frame.b1 / (length * length);
        const Eigen::Vector3d c2 = covariance * frame.b2 / (length * length);
        belief.covariance =
            frame.in_space(frame.b1.dot(c1), frame.b1.dot(c2), frame.b2.dot(c2));
        belief.trust = trust::good;
        return belief;
    }
};

}  // namespace gnomon
