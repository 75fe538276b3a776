// SPDX-License-Identifier: BSL-1.0
/// @file
/// On which side of a line or plane a point lies. A bound on the rounding error settles all but
/// near-ties, which are computed without rounding.
///
/// Shewchuk, Adaptive Precision Floating-Point Arithmetic and Fast Robust Geometric Predicates,
/// 1997. Exact for coordinates up to 1 in magnitude that are zero or above 1e-80.
#pragma once

#include <limits>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/neighborhoods/detail/expansion.hpp>

namespace gnomon::detail {

/// Twice the signed area of the triangle ((ax, ay), (bx, by), (cx, cy)), positive if it is
/// counterclockwise. The sign is exact.
[[nodiscard]] inline double signed_area(double ax, double ay, double bx, double by, double cx,
                                        double cy) {
    const double left = (ax - cx) * (by - cy);
    const double right = (ay - cy) * (bx - cx);
    const double area = left - right;
    constexpr double bound = 4.0 * std::numeric_limits<double>::epsilon();  // of rounding
    if (std::abs(area) > bound * (std::abs(left) + std::abs(right))) return area;
    return (exact_difference(ax, cx) * exact_difference(by, cy) +
            exact_difference(cy, ay) * exact_difference(bx, cx))
        .value();
}

/// Six times the volume of the tetrahedron (a, b, c, d), without the error of cancellation.
[[nodiscard]] inline double exact_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                         const Eigen::Vector3d& c, const Eigen::Vector3d& d) {
    const auto part = [&](int i, int j, int k) {
        return (exact_difference(b[i], a[i]) * exact_difference(c[j], a[j]) +
                exact_difference(a[j], b[j]) * exact_difference(c[i], a[i])) *
               exact_difference(d[k], a[k]);
    };
    return ((part(0, 1, 2) + part(1, 2, 0)) + part(2, 0, 1)).value();
}

/// Six times the signed volume of the tetrahedron (a, b, c, d): positive if d lies on the side of
/// the plane through a, b and c from which these are counterclockwise. The sign is exact.
/// @param certainty  the relative error is at most 1 / certainty, or a few rounding units
[[nodiscard]] inline double signed_volume(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                          const Eigen::Vector3d& c, const Eigen::Vector3d& d,
                                          double certainty = 1.0) {
    const Eigen::Vector3d u = difference(b, a);
    const Eigen::Vector3d v = difference(c, a);
    const Eigen::Vector3d w = difference(d, a);
    double volume = 0.0;
    double magnitude = 0.0;
    for (int i = 0; i < 3; ++i) {
        const int j = i == 2 ? 0 : i + 1;
        const int k = i == 0 ? 2 : i - 1;
        const double left = u[i] * v[j];
        const double right = u[j] * v[i];
        volume += (left - right) * w[k];
        magnitude += (std::abs(left) + std::abs(right)) * std::abs(w[k]);
    }
    constexpr double bound = 8.0 * std::numeric_limits<double>::epsilon();  // of rounding
    if (std::abs(volume) > certainty * bound * magnitude) return volume;
    return exact_volume(a, b, c, d);
}

}  // namespace gnomon::detail
