// SPDX-License-Identifier: BSL-1.0
/// @file
/// A box and a cylinder seen by a range finder, with noise along the rays and true normals: the
/// simulated point cloud of the thesis's first benchmark.
///
/// Klasing 2010, Sec. 3.2.6, Scenario I, Fig. 3.3. Only returns from the two objects are kept.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/scan.hpp>

namespace gnomon {

/// Parameters of the scene; the defaults give 14,200 points within 1 %.
struct box_and_cylinder {
    double sigma = 0.015;         ///< standard deviation of the range [m]
    double scale = 1.0;           ///< of both objects, about their places on the floor
    angle step = degrees(0.161);  ///< of the angular raster, in azimuth and elevation
    std::uint64_t seed = 1;
};

/// A scan and what is true of it, point by point.
struct true_scan {
    gnomon::scan scan;
    std::vector<Eigen::Vector3d> normals;  ///< unit, outwards
    std::vector<std::int32_t> surfaces;    ///< number of the surface that was hit
};

namespace detail {

/// Where a ray from the view point along the unit vector u meets a surface, at a range [m].
struct ray_hit {
    double range;
    Eigen::Vector3d normal;
    std::int32_t surface;
};

/// Rotation of v by `a` about z.
[[nodiscard]] inline Eigen::Vector3d turned(const Eigen::Vector3d& v, angle a) {
    return {cos(a) * v.x() - sin(a) * v.y(), sin(a) * v.x() + cos(a) * v.y(), v.z()};
}

/// An upright box: the slab method. Surfaces: 0 to 5 for +x, -x, +y, -y, +z, -z of its own frame.
struct upright_box {
    Eigen::Vector3d center;
    Eigen::Vector3d half;
    angle yaw;

    [[nodiscard]] std::optional<ray_hit> first_hit(const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& u) const {
        const Eigen::Vector3d o = turned(from - center, radians(-yaw.radians()));
        const Eigen::Vector3d d = turned(u, radians(-yaw.radians()));
        double enter = 0.0;
        double leave = std::numeric_limits<double>::infinity();
        int axis = -1;
        for (int a = 0; a < 3; ++a) {
            if (d[a] == 0.0) {
                if (std::abs(o[a]) > half[a]) return std::nullopt;
                continue;
            }
            const double towards = d[a] > 0.0 ? -half[a] : half[a];
            const double in = (towards - o[a]) / d[a];
            if (in > enter) {
                enter = in;
                axis = a;
            }
            leave = std::min(leave, (-towards - o[a]) / d[a]);
        }
        if (axis < 0 || enter > leave) return std::nullopt;
        const bool negative = d[axis] > 0.0;  // the ray enters through the face that looks at it
        const Eigen::Vector3d normal = (negative ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
        return ray_hit{enter, turned(normal, yaw), 2 * axis + (negative ? 1 : 0)};
    }
};

/// An upright cylinder on z = 0. Surfaces: 6 the mantle, 7 the top.
struct upright_cylinder {
    Eigen::Vector2d axis;  ///< the x and y of its axis
    double radius;
    double height;

    [[nodiscard]] std::optional<ray_hit> first_hit(const Eigen::Vector3d& from,
                                                   const Eigen::Vector3d& u) const {
        const Eigen::Vector2d o = from.head<2>() - axis;
        const Eigen::Vector2d d = u.head<2>();
        const double a = d.squaredNorm();
        const double b = o.dot(d);
        const double discriminant = b * b - a * (o.squaredNorm() - radius * radius);
        if (discriminant < 0.0 || a == 0.0) return std::nullopt;
        const double t = (-b - std::sqrt(discriminant)) / a;
        const double z = from.z() + t * u.z();
        if (t > 0.0 && z >= 0.0 && z <= height) {
            const Eigen::Vector2d n = (o + t * d) / radius;
            return ray_hit{t, {n.x(), n.y(), 0.0}, 6};
        }
        const double t_top = (height - from.z()) / u.z();
        if (from.z() > height && t_top > 0.0 && (o + t_top * d).norm() <= radius) {
            return ray_hit{t_top, Eigen::Vector3d::UnitZ(), 7};
        }
        return std::nullopt;
    }
};

}  // namespace detail

/// The scan of the scene, from one view point, scan line by scan line.
///
/// @throws std::invalid_argument  unless scale and step are positive and sigma is not negative
/// Complexity: one ray per step of a raster of about 50 by 45 degrees. The same seed gives the same
/// bytes.
[[nodiscard]] inline true_scan simulate(const box_and_cylinder& scene) {
    detail::require(scene.scale > 0.0 && scene.sigma >= 0.0 && scene.step > degrees(0.001),
                    "box_and_cylinder: scale and step must be positive, sigma not negative");
    const Eigen::Vector3d sensor(0.0, 0.0, 0.8);
    const double s = scene.scale;
    const detail::upright_box box{
        {2.2, -0.55, 0.30 * s}, Eigen::Vector3d::Constant(0.30 * s), degrees(30)};
    const detail::upright_cylinder cylinder{{2.4, 0.55}, 0.30 * s, 0.90 * s};

    true_scan result;
    result.scan.viewpoints = sensor;
    const auto lines = static_cast<std::size_t>(degrees(70).radians() / scene.step.radians());
    const auto beams = static_cast<std::size_t>(degrees(70).radians() / scene.step.radians());
    for (std::size_t line = 0; line < lines; ++line) {
        for (std::size_t beam = 0; beam < beams; ++beam) {
            const angle azimuth =
                radians(degrees(-35).radians() + static_cast<double>(line) * scene.step.radians());
            const angle elevation =
                radians(degrees(-45).radians() + static_cast<double>(beam) * scene.step.radians());
            const Eigen::Vector3d u(cos(elevation) * cos(azimuth), cos(elevation) * sin(azimuth),
                                    sin(elevation));
            auto hit = box.first_hit(sensor, u);
            const auto other = cylinder.first_hit(sensor, u);
            if (other && (!hit || other->range < hit->range)) hit = other;
            if (!hit) continue;
            random_stream noise(scene.seed, line * beams + beam);
            result.scan.points.push_back(sensor +
                                         (hit->range + scene.sigma * noise.gaussian()) * u);
            result.normals.push_back(hit->normal);
            result.surfaces.push_back(hit->surface);
        }
    }
    return result;
}

}  // namespace gnomon
