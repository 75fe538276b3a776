// SPDX-License-Identifier: BSL-1.0
/// @file
/// Sphere, cylinder and cone as functions of their parameters: signed distance of a point, normal
/// and curvature at its foot, derivatives of the distance, and the surface a small step away. These
/// are all that the regression on a surface uses. Each has
///
///     parameters, is_length       their number N, and which of them are lengths
///     foot_of(x)                  the `surface_foot` of a point, or a type derived from it
///     gradient(foot)              the derivatives of its distance with respect to the N parameters
///     moved(step)                 the surface with the parameters changed by `step`
///     is_valid()                  whether the parameters are those of a surface
///     radius
///
/// in lengths of which the points span about one, relative to their centroid.
///
/// For the equations: G. Lukacs, R. Martin and D. Marshall, Faithful least-squares fitting of
/// spheres, cylinders, cones and tori for reliable segmentation, 1998, with an axis that turns
/// about two of its own normals in place of angles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>

namespace gnomon::detail {

/// The nearest point of a surface to a point.
struct surface_foot {
    double distance;         ///< of the point from the surface, positive outside
    Eigen::Vector3d normal;  ///< of the surface there, outwards: the gradient of the distance
    double curvature;        ///< the sum of the principal curvatures there
};

/// The radius of a flatter surface is not determined, as the points span about one.
inline constexpr double largest_radius = 1e6;  // numerical

/// Parameters: center (3), radius.
struct sphere_surface {
    static constexpr std::size_t parameters = 4;
    static constexpr std::array is_length{true, true, true, true};

    Eigen::Vector3d center{0.0, 0.0, 0.0};
    double radius = 1.0;

    [[nodiscard]] surface_foot foot_of(const Eigen::Vector3d& x) const {
        const Eigen::Vector3d d = difference(x, center);
        const double distant = length(d);
        const Eigen::Vector3d n =
            distant > 0.0 ? scaled(1.0 / distant, d) : Eigen::Vector3d(0.0, 0.0, 1.0);
        return {distant - radius, n, 2.0 / radius};
    }

    [[nodiscard]] std::array<double, 4> gradient(const surface_foot& foot) const {
        return {-foot.normal[0], -foot.normal[1], -foot.normal[2], -1.0};
    }

    [[nodiscard]] sphere_surface moved(const std::array<double, 4>& step) const {
        return {{center[0] + step[0], center[1] + step[1], center[2] + step[2]}, radius + step[3]};
    }

    [[nodiscard]] bool is_valid() const {
        return all_finite(center) && radius > 0.0 && radius < largest_radius;
    }
};

/// The surface of a line that revolves about an axis, at an angle to it, which is constant 0 for
/// five parameters: a cylinder. The sixth is that angle: a cone.
///
/// Parameters: shifts of the axis along e1 and e2, turns of the axis towards e1 and e2, radius
/// at `point`, half-angle.
template <std::size_t N>
struct revolved_line {
    static constexpr std::size_t parameters = N;
    static constexpr std::array is_length{true, true, false, false, true, false};

    struct foot : surface_foot {
        double along;            ///< coordinate of the point along the axis, from `point`
        double distant;          ///< its distance from the axis
        Eigen::Vector3d across;  ///< unit vector from the axis to it
    };

    Eigen::Vector3d point{0.0, 0.0, 0.0};  ///< of the axis that is nearest to the origin
    Eigen::Vector3d axis{0.0, 0.0, 1.0};   ///< of unit length
    Eigen::Vector3d e1{1.0, 0.0, 0.0};     ///< of unit length, orthogonal to the axis
    double radius = 1.0;                   ///< at `point`, across the axis
    double half_angle = 0.0;               ///< [rad]; the radius increases along the axis
    double cosine = 1.0, sine = 0.0;       ///< of half_angle

    [[nodiscard]] foot foot_of(const Eigen::Vector3d& x) const {
        const Eigen::Vector3d d = difference(x, point);
        const double along = dot(d, axis);
        const Eigen::Vector3d out = combined(1.0, d, -along, axis);
        const double distant = length(out);
        const Eigen::Vector3d across = distant > 0.0 ? scaled(1.0 / distant, out) : e1;
        const double distance = (distant - radius) * cosine - along * sine;
        const double radius_there = std::max(distant - distance * cosine, radius / largest_radius);
        return {{distance, combined(cosine, across, -sine, axis), cosine / radius_there},
                along,
                distant,
                across};
    }

    [[nodiscard]] std::array<double, N> gradient(const foot& f) const {
        const double n1 = dot(f.across, e1), n2 = dot(f.across, cross(axis, e1));
        const double lever = f.along * cosine + f.distant * sine;
        std::array<double, N> g{-n1 * cosine, -n2 * cosine, -n1 * lever, -n2 * lever, -cosine};
        if constexpr (N > 5) g[5] = (radius - f.distant) * sine - f.along * cosine;
        return g;
    }

    [[nodiscard]] revolved_line moved(const std::array<double, N>& step) const {
        const Eigen::Vector3d e2 = cross(axis, e1);
        revolved_line m = *this;
        m.point = combined(1.0, point, step[0], e1, step[1], e2);
        m.axis = combined(1.0, axis, step[2], e1, step[3], e2);
        m.radius += step[4];
        if constexpr (N > 5) {
            m.half_angle += step[5];
            m.cosine = std::cos(m.half_angle);
            m.sine = std::sin(m.half_angle);
        }
        return m.normalized();
    }

    /// The same surface with `point` nearest to the origin, e1 and the axis orthonormal, and the
    /// axis in the direction in which the radius increases.
    [[nodiscard]] revolved_line normalized() const {
        revolved_line m = *this;
        m.axis = scaled((sine < 0.0 ? -1.0 : 1.0) / length(axis), axis);
        m.sine = std::abs(sine);
        m.half_angle = std::atan2(m.sine, cosine);  // a step may be of several turns
        const Eigen::Vector3d first = combined(1.0, e1, -dot(e1, m.axis), m.axis);
        m.e1 = scaled(1.0 / length(first), first);
        const double shift = -dot(point, m.axis);
        m.point = combined(1.0, point, shift, m.axis);
        m.radius += shift * m.sine / cosine;
        return m;
    }

    [[nodiscard]] bool is_valid() const {
        return all_finite(point) && all_finite(axis) && all_finite(e1) && radius > 0.0 &&
               radius < largest_radius && cosine > 1.0 / largest_radius;
    }
};

using cylinder_surface = revolved_line<5>;
using cone_surface = revolved_line<6>;

}  // namespace gnomon::detail
