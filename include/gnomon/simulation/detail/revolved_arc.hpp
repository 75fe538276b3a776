// SPDX-License-Identifier: BSL-1.0
/// @file
/// The ray intersection of all surfaces of revolution: cylinder, cone, sphere and spline profiles
/// consist of bands about the z axis whose squared radius is a quadratic function of the height.
/// Their intersection with a ray is the root of a quadratic equation.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/ray.hpp>

namespace gnomon::simulation::detail {

/// The band low <= z <= high of the surface x^2 + y^2 = a z^2 + b z + c.
struct revolved_arc {
    double low;   ///< [m]
    double high;  ///< [m]
    double a;
    double b;
    double c;

    [[nodiscard]] double squared_radius(double z) const { return (a * z + b) * z + c; }
};

/// The squared radii of the discs that close a sequence of arcs [m^2]; empty where it is open.
struct end_discs {
    std::optional<double> bottom;
    std::optional<double> top;
};

/// Keeps the nearest of several candidate hits.
class nearest_revolved_hit {
  public:
    /// The origin of `given` is first moved along the ray to the point nearest to the shape's
    /// origin: far from it the coefficients of the quadratic equations would suffer cancellation.
    /// @param size  the largest coordinate of the arcs [m]
    nearest_revolved_hit(const ray& given, double size)
        : shift_(-given.origin.dot(given.direction)),
          near_{given.point_at(shift_), given.direction, given.reach},
          margin_(1e-12 * (size + near_.origin.cwiseAbs().sum())),
          least_range_(1e-12 * given.origin.cwiseAbs().sum()) {}

    /// Tests an arc of the mantle, surface 0.
    void try_mantle(const revolved_arc& arc) {
        const Eigen::Vector3d& o = near_.origin;
        const Eigen::Vector3d& u = near_.direction;
        const double a = u.x() * u.x() + u.y() * u.y() - arc.a * u.z() * u.z();
        const double b = o.x() * u.x() + o.y() * u.y() - (arc.a * o.z() + 0.5 * arc.b) * u.z();
        const double c = o.x() * o.x() + o.y() * o.y() - arc.squared_radius(o.z());
        double discriminant = b * b - a * c;
        // Zero up to rounding: a tangent ray, or a ray through the apex of a cone.
        if (discriminant < 0.0 && discriminant > -1e-15 * b * b) discriminant = 0.0;
        if (!(discriminant >= 0.0)) return;
        // The root without cancellation is computed directly, the other one from the product of the
        // roots.
        const double q = -(b + std::copysign(std::sqrt(discriminant), b));
        for (const double t : {q / a, c / q}) {
            const double z = o.z() + t * u.z();
            if (!(z >= arc.low - margin_ && z <= arc.high + margin_)) continue;
            const Eigen::Vector3d gradient(o.x() + t * u.x(), o.y() + t * u.y(),
                                           -(arc.a * z + 0.5 * arc.b));
            keep(t, gradient, 0);
        }
    }

    /// Tests a disc about the axis.
    void try_disc(double z, double squared_radius, std::int32_t surface) {
        const double t = (z - near_.origin.z()) / near_.direction.z();
        const double x = near_.origin.x() + t * near_.direction.x();
        const double y = near_.origin.y() + t * near_.direction.y();
        if (x * x + y * y <= squared_radius) keep(t, {0.0, 0.0, 1.0}, surface);
    }

    [[nodiscard]] const std::optional<ray_hit>& hit() const { return hit_; }

  private:
    void keep(double t, const Eigen::Vector3d& gradient, std::int32_t surface) {
        const double range = shift_ + t;
        if (!(range > least_range_ && range <= near_.reach)) return;
        const double length = std::sqrt(gradient.dot(gradient));
        const double sign = gradient.dot(near_.direction) > 0.0 ? -1.0 : 1.0;
        // The normal at the apex of a cone is undefined; the reported one faces the ray.
        hit_ = ray_hit{range, length > 0.0 ? gradient * (sign / length) : near_.direction * -1.0,
                       surface};
        near_.reach = range;
    }

    double shift_;
    ray near_;            // its reach counts from the origin of the given ray
    double margin_;       // of heights, so that neighboring arcs leave no gap
    double least_range_;  // rounding of range 0: a ray does not meet the surface of its origin
    std::optional<ray_hit> hit_;
};

/// The first hit of a sequence of arcs, lowest first, and the discs that close it. Surfaces: 0 the
/// mantle, 1 the bottom, 2 the top.
[[nodiscard]] inline std::optional<ray_hit> first_hit_of(std::span<const revolved_arc> arcs,
                                                         end_discs discs, const ray& r) {
    const double low = arcs.front().low;
    const double high = arcs.back().high;
    nearest_revolved_hit nearest(r, std::max(std::abs(low), std::abs(high)));
    for (const revolved_arc& arc : arcs) nearest.try_mantle(arc);
    if (discs.bottom) nearest.try_disc(low, *discs.bottom, 1);
    if (discs.top) nearest.try_disc(high, *discs.top, 2);
    return nearest.hit();
}

}  // namespace gnomon::simulation::detail
