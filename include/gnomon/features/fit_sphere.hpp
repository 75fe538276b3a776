// SPDX-License-Identifier: BSL-1.0
/// @file
/// The sphere through points of a segment, with its covariance.
///
///     const gnomon::constant_noise noise{0.005};
///     const auto ball = gnomon::fit_sphere(scan, surface, parts[s], noise);
///     if (ball.has_parameters()) use(ball.center, ball.radius);
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/features/detail/curved_surfaces.hpp>
#include <gnomon/features/detail/fit_surface.hpp>
#include <gnomon/features/surface_fit.hpp>

namespace gnomon {

/// A sphere with its covariance. All numbers are zero if there are no parameters.
struct sphere_estimate : surface_fit {
    Eigen::Vector3d center{0.0, 0.0, 0.0};  ///< [m]
    double radius = 0.0;                    ///< [m]
    /// Of the three coordinates of the center and of the radius [m^2].
    detail::parameter_covariance<4> covariance = detail::parameter_covariance<4>::Zero();
};

/// Fits a sphere to some points, such as a segment, by nonlinear least squares.
///
/// @param points      any point range of n points [m], or the `spatial_index` of them; where view
///                    points are known, noise lies along the rays, else it is the same in all
///                    directions
/// @param surface     n surface elements with normals, such as the result of `estimate_normals`,
///                    for a first sphere. Signs do not matter. Normals that are missing or not
///                    finite are left out, their points are not.
/// @param members     the indices of the points of the fit; those that are not finite are left out
/// @param noise       of the sensor
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the sphere, its covariance and the outcome; see `surface_fit`
/// @throws std::invalid_argument  if points, surface or view points differ in number, or an index
///                                is not below n
/// Complexity: O(members).
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] sphere_estimate fit_sphere(const R& points, const Surface& surface,
                                         std::span<const point_index> members,
                                         const noise_curve& noise, const X& run = {},
                                         Proj projection = {}) {
    return detail::fitted_to<detail::sphere_surface, sphere_estimate>(
        points, surface, members, noise, run, std::move(projection),
        [](sphere_estimate& e, const detail::sphere_surface& s,
           const detail::regression_cloud& cloud) {
            e.center = cloud.position(s.center);
            e.radius = cloud.metres(s.radius);
        });
}

/// Fits a sphere to all points of a range. Parameters, result and errors are as above.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] sphere_estimate fit_sphere(const R& points, const Surface& surface,
                                         const noise_curve& noise, const X& run = {},
                                         Proj projection = {}) {
    return fit_sphere(points, surface, detail::all_indices(std::ranges::size(points)), noise, run,
                      std::move(projection));
}

}  // namespace gnomon
