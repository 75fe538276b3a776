// SPDX-License-Identifier: BSL-1.0
/// @file
/// The cylinder through points of a segment, such as a pipe or a pole, with its covariance.
///
///     const gnomon::constant_noise noise{0.005};
///     const auto pole = gnomon::fit_cylinder(scan, surface, parts[s], noise);
///     const double deviation = std::sqrt(pole.covariance(4, 4));  // of the radius [m]
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

/// A cylinder with its covariance. All numbers are zero if there are no parameters.
struct cylinder_estimate : surface_fit {
    /// The point of the axis that is nearest to the centroid of the points [m].
    Eigen::Vector3d axis_point{0.0, 0.0, 0.0};
    /// Unit columns, a right-handed frame: two normals of the axis, and its direction.
    Eigen::Matrix3d axes = detail::diagonal(0.0, 0.0, 0.0);
    double radius = 0.0;  ///< [m]
    /// Of five parameters: the shifts of the axis at `axis_point` along axes 0 and 1 [m], the turns
    /// of its direction towards axes 0 and 1 [rad], and the radius [m].
    detail::parameter_covariance<5> covariance = detail::parameter_covariance<5>::Zero();

    /// The direction of the axis, of unit length, with an arbitrary sign.
    [[nodiscard]] Eigen::Vector3d direction() const { return detail::column(axes, 2); }
};

/// Fits a cylinder to some points, such as a segment, by nonlinear least squares.
///
/// @param points      any point range of n points [m], or the `spatial_index` of them; where view
///                    points are known, noise lies along the rays, else it is the same in all
///                    directions
/// @param surface     n surface elements with normals, such as the result of `estimate_normals`,
///                    for a first cylinder. Signs do not matter. Normals that are missing or not
///                    finite are left out, their points are not.
/// @param members     the indices of the points of the fit; those that are not finite are left out
/// @param noise       of the sensor
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the cylinder, its covariance and the outcome; see `surface_fit`
/// @throws std::invalid_argument  if points, surface or view points differ in number, or an index
///                                is not below n
/// Complexity: O(members).
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] cylinder_estimate fit_cylinder(const R& points, const Surface& surface,
                                             std::span<const point_index> members,
                                             const noise_curve& noise, const X& run = {},
                                             Proj projection = {}) {
    return detail::fitted_to<detail::cylinder_surface, cylinder_estimate>(
        points, surface, members, noise, run, std::move(projection),
        [](cylinder_estimate& e, const detail::cylinder_surface& s,
           const detail::regression_cloud& cloud) {
            e.axes = detail::from_columns(s.e1, detail::cross(s.axis, s.e1), s.axis);
            e.axis_point = cloud.position(s.point);
            e.radius = cloud.metres(s.radius);
        });
}

/// Fits a cylinder to all points of a range. Parameters, result and errors are as above.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] cylinder_estimate fit_cylinder(const R& points, const Surface& surface,
                                             const noise_curve& noise, const X& run = {},
                                             Proj projection = {}) {
    return fit_cylinder(points, surface, detail::all_indices(std::ranges::size(points)), noise, run,
                        std::move(projection));
}

}  // namespace gnomon
