// SPDX-License-Identifier: BSL-1.0
/// @file
/// PlaneEKF line by line as in the thesis, for the record: the state is a 3-vector of any length,
/// it starts anywhere, and passing the data again counts them again. Some starts never come round,
/// and the covariance promises far too much; `plane_ekf` is the filter to use.
///
/// Klasing 2010, Sec. 3.2.7, Alg. 3.2, Eqs. (3.16)-(3.18).
#pragma once

#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/range_of_plane.hpp>
#include <gnomon/normals/detail/require_sigma.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/normal_belief.hpp>

namespace gnomon {

/// Models `ray_estimator`. Needs two neighbors. O(passes k). The covariance is that of the
/// algorithm, made one of the unit normal.
struct literal_plane_ekf {
    static constexpr auto sensitive_to =
        sensitivity::order | sensitivity::units | sensitivity::axes;

    double sigma = 0.015;          ///< standard deviation of the range [m]
    int passes = 5;                ///< over all points
    double prior_variance = 10.0;  ///< Sigma_0 = 10 I
    std::uint64_t seed = 1;        ///< of the random start x_0

    /// @throws std::invalid_argument  unless sigma and prior variance are positive and finite and
    ///                                there is a pass
    [[nodiscard]] normal_belief operator()(const Eigen::Vector3d& p, ring_view ring,
                                           const Eigen::Vector3d& viewpoint = {0.0, 0.0,
                                                                               0.0}) const {
        detail::require_sigma(sigma);
        detail::require(passes >= 1 && prior_variance > 0.0 && std::isfinite(prior_variance),
                        "literal_plane_ekf: needs a pass and a positive prior variance");
        using namespace detail;  // dot, scaled, ...
        normal_belief belief;
        if (ring.size() < 2) return belief;

        random_stream random(seed);
        Eigen::Vector3d x;  // line 1
        for (int a = 0; a < 3; ++a) x[a] = random.gaussian();
        x = scaled(1.0 / length(x), x);
        Eigen::Matrix3d covariance = diagonal(prior_variance, prior_variance, prior_variance);
        const moments m = moments_about(p, ring);
        const Eigen::Vector3d seen = difference(p, viewpoint);
        const Eigen::Vector3d centroid = combined(1.0, seen, 1.0, m.mean_with_point());  // line 2
        const auto take_in = [&](const Eigen::Vector3d& q) {
            const double range = length(q);
            const Eigen::Vector3d u = scaled(1.0 / range, q);                 // line 4
            const double h = range_of_plane(centroid, x, u);                  // line 5
            const Eigen::Vector3d jacobian = range_gradient(centroid, x, u);  // line 6
            const Eigen::Vector3d ph = product(covariance, jacobian);
            const double gain = 1.0 / (dot(jacobian, ph) + sigma * sigma);  // line 7: K = gain ph
            x = combined(1.0, x, (range - h) * gain, ph);                   // line 8
            add_outer(covariance, -gain, ph, ph);                           // line 9
        };
        for (int pass = 0; pass < passes; ++pass) {
            take_in(seen);
            for (const Eigen::Vector3d& q : ring) take_in(difference(q, viewpoint));
        }

        const double size = length(x);
        double sum = size;
        for (int i = 0; i < 9; ++i) sum += covariance.data()[i];
        belief.trust = std::isfinite(sum) ? trust::degenerate : trust::not_finite;
        if (!std::isfinite(sum) || size == 0.0) return belief;
        belief.normal = scaled(1.0 / size, x);
        const detail::tangent_basis frame(belief.normal);
        const Eigen::Vector3d c1 = scaled(1.0 / (size * size), product(covariance, frame.b1));
        const Eigen::Vector3d c2 = scaled(1.0 / (size * size), product(covariance, frame.b2));
        belief.covariance = frame.in_space(dot(frame.b1, c1), dot(frame.b1, c2), dot(frame.b2, c2));
        belief.trust = trust::good;
        return belief;
    }
};

}  // namespace gnomon
