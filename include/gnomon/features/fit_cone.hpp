// SPDX-License-Identifier: BSL-1.0
/// @file
/// The circular cone through points of a segment, with its covariance.
///
///     const auto cone = gnomon::fit_cone(scan, surface, parts[s], gnomon::constant_noise{0.005});
///     use(cone.apex(), cone.direction(), cone.half_angle);
///
/// A cylinder is a cone with the half-angle 0, whose parameters are determined as well; its apex is
/// not. So the covariance refers to the radius near the points, not to the apex.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
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

/// A cone with its covariance. All numbers are zero if there are no parameters.
struct cone_estimate : surface_fit {
    /// The point of the axis that is nearest to the centroid of the points [m].
    Eigen::Vector3d axis_point{0.0, 0.0, 0.0};
    /// Unit columns, a right-handed frame: two normals of the axis, and its direction, away from
    /// the apex.
    Eigen::Matrix3d axes = detail::diagonal(0.0, 0.0, 0.0);
    double radius = 0.0;  ///< at `axis_point`, across the axis [m]
    angle half_angle;     ///< between the axis and the lines on the cone
    /// Of six parameters: the shifts of the axis at `axis_point` along axes 0 and 1 [m], the turns
    /// of its direction towards axes 0 and 1 [rad], the radius at `axis_point` [m], and the
    /// half-angle [rad].
    detail::parameter_covariance<6> covariance = detail::parameter_covariance<6>::Zero();

    /// The direction of the axis, of unit length, away from the apex.
    [[nodiscard]] Eigen::Vector3d direction() const { return detail::column(axes, 2); }

    /// The apex [m]; far away if the half-angle is near 0.
    [[nodiscard]] Eigen::Vector3d apex() const {
        constexpr double least = 1e-150;  // numerical: against overflow
        const double height = radius / std::max(std::tan(half_angle.radians()), least);
        return detail::combined(1.0, axis_point, -height, direction());
    }
};

/// Fits a cone to some points, such as a segment, by nonlinear least squares.
///
/// @param points      any point range of n points [m], or the `spatial_index` of them; where view
///                    points are known, noise lies along the rays, else it is the same in all
///                    directions
/// @param surface     n surface elements with normals, such as the result of `estimate_normals`,
///                    for a first cone. Signs do not matter. Normals that are missing or not
///                    finite are left out, their points are not.
/// @param members     the indices of the points of the fit; those that are not finite are left out
/// @param noise       of the sensor
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the cone, its covariance and the outcome; see `surface_fit`
/// @throws std::invalid_argument  if points, surface or view points differ in number, or an index
///                                is not below n
/// Complexity: O(members).
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] cone_estimate fit_cone(const R& points, const Surface& surface,
                                     std::span<const point_index> members, const noise_curve& noise,
                                     const X& run = {}, Proj projection = {}) {
    return detail::fitted_to<detail::cone_surface, cone_estimate>(
        points, surface, members, noise, run, std::move(projection),
        [](cone_estimate& e, const detail::cone_surface& s, const detail::regression_cloud& cloud) {
            e.axes = detail::from_columns(s.e1, detail::cross(s.axis, s.e1), s.axis);
            e.axis_point = cloud.position(s.point);
            e.radius = cloud.metres(s.radius);
            e.half_angle = radians(s.half_angle);
        });
}

/// Fits a cone to all points of a range. Parameters, result and errors are as above.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] cone_estimate fit_cone(const R& points, const Surface& surface,
                                     const noise_curve& noise, const X& run = {},
                                     Proj projection = {}) {
    return fit_cone(points, surface, detail::all_indices(std::ranges::size(points)), noise, run,
                    std::move(projection));
}

}  // namespace gnomon
