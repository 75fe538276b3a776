// SPDX-License-Identifier: BSL-1.0
/// @file
/// The solids that others are built of. Lengths of the shapes' own unit, which is about their size.
#pragma once

#include <cmath>
#include <numbers>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "sampling.hpp"
#include "solid.hpp"

namespace known_normals {

inline solid ball(const Vector3d& center, double radius) {
    return {{{4.0 * std::numbers::pi * radius * radius,
              [=](dice& d) {
                  const Vector3d n = d.gaussian().normalized();
                  return surface_point{center + radius * n, n};
              }}},
            [=](const Vector3d& p) { return (p - center).squaredNorm() < radius * radius; }};
}

/// Along the axes, between two corners.
inline solid box(const Vector3d& low, const Vector3d& high) {
    const Vector3d size = high - low;
    const Vector3d sides(size.y() * size.z(), size.z() * size.x(), size.x() * size.y());
    const double half = sides.sum();
    return {{{2.0 * half,
              [=](dice& d) {
                  double u = d.uniform(0.0, half);
                  int axis = 0;
                  while (axis < 2 && u >= sides[axis]) u -= sides[axis++];
                  Vector3d p = low + d.in_cube(0.0, 1.0).cwiseProduct(size);
                  const bool top = d.uniform() < 0.5;
                  p[axis] = top ? high[axis] : low[axis];
                  Vector3d n(0.0, 0.0, 0.0);
                  n[axis] = top ? 1.0 : -1.0;
                  return surface_point{p, n};
              }}},
            [=](const Vector3d& p) {
                return (p.array() > low.array()).all() && (p.array() < high.array()).all();
            }};
}

/// Between a disc about `a` and one about `b`: a cone, if one of the radii is zero.
inline solid frustum(const Vector3d& a, double radius_a, const Vector3d& b, double radius_b) {
    const double height = (b - a).norm();
    const Vector3d z = (b - a) / height;
    const Vector3d x = z.unitOrthogonal();
    const Vector3d y = z.cross(x);
    const double slant = std::hypot(height, radius_a - radius_b);
    const double area_a = std::numbers::pi * radius_a * radius_a;
    const double area_b = std::numbers::pi * radius_b * radius_b;
    const double whole = std::numbers::pi * (radius_a + radius_b) * slant + area_a + area_b;
    return {{{whole,
              [=](dice& d) {
                  const double u = d.uniform(0.0, whole);
                  const double turn = d.uniform(0.0, 2.0 * std::numbers::pi);
                  const Vector3d out = std::cos(turn) * x + std::sin(turn) * y;
                  const double v = d.uniform();
                  if (u < area_a) return surface_point{a + radius_a * std::sqrt(v) * out, -z};
                  if (u < area_a + area_b)
                      return surface_point{b + radius_b * std::sqrt(v) * out, z};
                  const double a2 = radius_a * radius_a;  // area is linear in the squared radius
                  const double r = std::sqrt(a2 + v * (radius_b * radius_b - a2));
                  const double t =
                      radius_a == radius_b ? v : (r - radius_a) / (radius_b - radius_a);
                  return surface_point{a + t * height * z + r * out,
                                       (height * out + (radius_a - radius_b) * z) / slant};
              }}},
            [=](const Vector3d& p) {
                const double t = z.dot(p - a) / height;
                if (t <= 0.0 || t >= 1.0) return false;
                const double r = radius_a + t * (radius_b - radius_a);
                return (p - a - t * height * z).squaredNorm() < r * r;
            }};
}

inline solid cylinder(const Vector3d& a, const Vector3d& b, double radius) {
    return frustum(a, radius, b, radius);
}

/// @param axis  of unit length
/// @param neighbors  from the center to the middle of the tube
inline solid torus(const Vector3d& center, const Vector3d& axis, double neighbors, double tube) {
    const Vector3d x = axis.unitOrthogonal();
    const Vector3d y = axis.cross(x);
    return {{{4.0 * std::numbers::pi * std::numbers::pi * neighbors * tube,
              [=](dice& d) {
                  double g = 0.0;
                  do {
                      g = d.uniform(0.0, 2.0 * std::numbers::pi);
                  } while (d.uniform() * (neighbors + tube) > neighbors + tube * std::cos(g));
                  const double turn = d.uniform(0.0, 2.0 * std::numbers::pi);
                  const Vector3d out = std::cos(turn) * x + std::sin(turn) * y;
                  const Vector3d n = std::cos(g) * out + std::sin(g) * axis;
                  return surface_point{center + neighbors * out + tube * n, n};
              }}},
            [=](const Vector3d& p) {
                const double h = axis.dot(p - center);
                const double rho = (p - center - h * axis).norm() - neighbors;
                return rho * rho + h * h < tube * tube;
            }};
}

}  // namespace known_normals
