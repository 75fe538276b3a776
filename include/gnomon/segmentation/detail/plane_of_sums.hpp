// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planes of whole regions from sums over their points about one origin: that of two regions
/// together follows without looking at a point again.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// The least squares plane of points.
struct fitted_plane {
    gnomon::plane plane{Eigen::Vector3d(0.0, 0.0, 0.0), 0.0};  ///< no normal if not determined
    double variance = 0.0;                                     ///< of the points across it [m^2]
};

/// Adds the moments about the same point.
inline void add(moments& to, const moments& more) {
    to.count += more.count;
    for (int j = 0; j < 3; ++j) {
        to.sum[j] += more.sum[j];
        for (int i = j; i < 3; ++i) to.outer(i, j) += more.outer(i, j);
    }
}

/// The plane of points with these moments about `origin`.
[[nodiscard]] inline fitted_plane fitted(const moments& m, const Eigen::Vector3d& origin) {
    fitted_plane f;
    if (m.count < 3) return f;
    const plane_fit fit = plane_of_least_spread(m.covariance_of_neighbors(), 0.0);
    if (!usable(fit.trust)) return f;
    const Eigen::Vector3d mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
    f.plane = {fit.normal, dot(fit.normal, mean)};
    f.variance = fit.spectrum.lambda[2];
    return f;
}

/// The mean squared distance [m^2] of points with these moments about `origin` from a plane.
[[nodiscard]] inline double mean_square(const moments& m, const Eigen::Vector3d& origin,
                                        const plane& to) {
    const Eigen::Matrix3d c = m.covariance_of_neighbors();
    const Eigen::Vector3d mean = combined(1.0, origin, 1.0 / static_cast<double>(m.count), m.sum);
    const double off = to.signed_distance(mean);
    return dot(to.normal, product(c, to.normal)) + off * off;
}

}  // namespace gnomon::detail
