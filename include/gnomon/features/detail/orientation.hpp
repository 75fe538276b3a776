// SPDX-License-Identifier: BSL-1.0
/// @file
/// On which side of a line or plane a point lies. A bound on the rounding error settles all but
/// near-ties, which are computed with more digits, and in the end without rounding.
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

/// The sum of two doubles of which the second is a rounding error of the first. Products and sums
/// have relative errors of a few squared epsilon.
struct twofold {
    double high;
    double low;

    [[nodiscard]] static twofold difference(double a, double b) {
        const double rounded = a - b;
        return {rounded, sum_error(a, -b, rounded)};
    }
    [[nodiscard]] friend twofold operator*(const twofold& a, const twofold& b) {
        const double most = rounded_product(a.high, b.high);
        const double rest = std::fma(a.high, b.high, -most) + (a.high * b.low + a.low * b.high);
        const double sum = most + rest;
        return {sum, rest - (sum - most)};
    }
    [[nodiscard]] friend twofold operator+(const twofold& a, const twofold& b) {
        const double most = a.high + b.high;
        const double rest = sum_error(a.high, b.high, most) + (a.low + b.low);
        const double sum = most + rest;
        return {sum, rest - (sum - most)};
    }
};

/// Six times the volume of the tetrahedron (a, b, c, d), in the arithmetic of the differences that
/// minus(x, y) returns.
template <class Difference>
[[nodiscard]] auto volume_by(const Difference& minus, const Eigen::Vector3d& a,
                             const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                             const Eigen::Vector3d& d) {
    const auto part = [&](int i, int j, int k) {
        return (minus(b[i], a[i]) * minus(c[j], a[j]) + minus(a[j], b[j]) * minus(c[i], a[i])) *
               minus(d[k], a[k]);
    };
    return (part(0, 1, 2) + part(1, 2, 0)) + part(2, 0, 1);
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
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    constexpr double bound = 8.0 * epsilon;  // of rounding
    if (std::abs(volume) > certainty * bound * magnitude) return volume;
    const double close = volume_by(twofold::difference, a, b, c, d).high;
    constexpr double close_bound = 64.0 * epsilon * epsilon;  // of rounding
    if (std::abs(close) > certainty * close_bound * magnitude) return close;
    return volume_by(exact_difference, a, b, c, d).value();
}

}  // namespace gnomon::detail
