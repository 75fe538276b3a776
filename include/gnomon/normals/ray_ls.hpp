// SPDX-License-Identifier: BSL-1.0
/// @file
/// RayLS: the least squares plane under noise along the rays of a range finder. The unit ray u
/// meets the plane n . x = d at the range r with 1/r = m . u, where m = n/d: linear in m. Weighted
/// by r^4, the precision of 1/r, linear least squares is the maximum likelihood fit to first order.
/// It is a regression on two coordinates, without an eigenvalue problem.
///
/// Beyond the thesis. Badino et al., Fast and Accurate Computation of Surface Normals from Range
/// Images, ICRA 2011, fit the inverse range in range images; here the neighborhood is any set of
/// points.
#pragma once

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/ray_regression.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// The normal of a plane fitted along rays, with its distance from the view point.
struct ray_fit : normal_fit {
    double distance = 0.0;  ///< of the plane from the view point [m]
    /// The ratio of the standard deviations of the rays along their two principal directions, 0 to
    /// 1. Small for a single scan line, and for surfaces at grazing incidence.
    double ray_aspect_ratio = 0.0;

    /// The ray_aspect_ratio.
    [[nodiscard]] double aspect_ratio() const { return ray_aspect_ratio; }
};

namespace detail {

/// The regression of a point and at least two neighbors on their rays from the view point.
[[nodiscard]] inline ray_regression regression_of(const Eigen::Vector3d& p,
                                                  neighborhood_view neighbors,
                                                  const Eigen::Vector3d& viewpoint) {
    ray_regression r(difference(p, viewpoint));
    for (const Eigen::Vector3d& q : neighbors) r.add(difference(q, p));
    r.solve();
    return r;
}

/// The plane of a regression, weak below the given aspect ratio of the rays.
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
/// Trust: `weak` below `min_aspect_ratio`; `degenerate` where all rays lie in one plane, neighbors
/// are behind the view point, or the view point is the point itself.
struct ray_ls {
    double min_aspect_ratio = 0.05;  ///< of the rays, below which the normal is weak

    [[nodiscard]] ray_fit operator()(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                     const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        if (neighbors.size() < 2) return {};
        return detail::plane_seen(detail::regression_of(p, neighbors, viewpoint), min_aspect_ratio);
    }
};

}  // namespace gnomon
