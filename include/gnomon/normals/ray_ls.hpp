// SPDX-License-Identifier: BSL-1.0
/// @file
/// RayLS: a range finder errs along its rays, so fit the plane to what it measured. A plane n . x =
/// d is seen along the unit ray u at the range r with 1/r = m . u, m = n/d: linear in m. Weighted
/// by r^4, the precision of 1/r, least squares is the maximum likelihood fit of first order, and it
/// takes no eigenvalues: a regression on two coordinates.
///
/// Beyond the thesis. The inverse range is the idea of Badino et al., Fast and Accurate Computation
/// of Surface Normals from Range Images, ICRA 2011; here on any neighborhood in space.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// A plane as seen from the view point.
struct ray_fit : normal_fit {
    double distance = 0.0;  ///< of the plane from the view point [m]
    /// How the rays spread: the ratio of their smaller to their larger extent, 0 to 1. Small for a
    /// single scan line, and for surfaces seen under a grazing angle.
    double ray_aspect_ratio = 0.0;

    [[nodiscard]] double aspect_ratio() const { return ray_aspect_ratio; }
};

namespace detail {

/// The regression of a ring of at least two on the rays from the view point.
[[nodiscard]] inline ray_regression regression_of(const Eigen::Vector3d& p, ring_view ring,
                                                  const Eigen::Vector3d& viewpoint) {
    ray_regression r(difference(p, viewpoint));
    for (const Eigen::Vector3d& q : ring) r.add(difference(q, p));
    r.solve();
    return r;
}

/// The plane that a regression found, weak under the given aspect ratio of the rays.
[[nodiscard]] inline ray_fit plane_seen(const ray_regression& r, double min_aspect_ratio) {
    ray_fit fit;
    fit.trust = r.status();
    if (!usable(fit.trust)) return fit;
    const Eigen::Vector3d m = r.solution();
    const double size = length(m);
    fit.normal = scaled(1.0 / size, m);
    fit.distance = r.range() / size;
    fit.ray_aspect_ratio = r.aspect_ratio();
    fit.trust = fit.ray_aspect_ratio < min_aspect_ratio ? trust::weak : trust::good;
    return fit;
}

}  // namespace detail

/// Models `ray_estimator`. Needs two neighbors. O(k), about the time of `plane_pca` or less.
///
/// Trust: `weak` under `min_aspect_ratio`; `degenerate` where all rays lie in one plane, neighbors
/// are behind the view point, or the view point is the point itself.
struct ray_ls {
    double min_aspect_ratio = 0.05;  ///< of the rays, below which the normal is weak

    [[nodiscard]] ray_fit operator()(const Eigen::Vector3d& p, ring_view ring,
                                     const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        if (ring.size() < 2) return {};
        return detail::plane_seen(detail::regression_of(p, ring, viewpoint), min_aspect_ratio);
    }
};

}  // namespace gnomon
