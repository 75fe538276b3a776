// SPDX-License-Identifier: BSL-1.0
/// @file
/// Averaging methods: the normal is the weighted mean of the normals of the triangles that a point
/// makes with consecutive neighbors.
///
/// A k-nearest-neighbor ring comes in the order of distance, so that consecutive triangles turn
/// this way and that, and their normals cancel: the thesis's claim that such rings yield good
/// results holds only if the triangles are given a common sign. Rings in angular order (`delaunay`,
/// `sorted_around`) need no such help.
///
/// Klasing 2010, Eqs. (3.9)-(3.11), Tab. 3.2; Gouraud 1971; Jin, Lewis and West 2005.
#pragma once

#include <concepts>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {

/// What decides about the sign of each triangle's normal.
enum class triangle_sign : bool {
    from_order,   ///< the order of the two neighbors, as in the thesis
    to_viewpoint  ///< each normal is turned to the side of the view point first
};

/// A weight of the triangle (p, p + a, p + b) whose area is not zero.
/// @param a, b         offsets of the two neighbors [m]
/// @param double_area  |a x b| [m^2]
template <class W>
concept triangle_weight = requires(const W& weight, const Eigen::Vector3d& a, double double_area) {
    { weight(a, a, double_area) } -> std::convertible_to<double>;
};

/// Models `ray_estimator` and `cyclic_estimator`. Needs two neighbors. O(k).
///
/// Trust: `degenerate` where all triangles are, or where their normals cancel.
template <triangle_weight Weight>
struct averaging {
    static constexpr auto sensitive_to = sensitivity::order;
    static constexpr bool reads_fan = true;

    triangle_sign sign = triangle_sign::from_order;
    [[no_unique_address]] Weight weight = {};

    [[nodiscard]] normal_fit operator()(const Eigen::Vector3d& p, ring_view ring,
                                        const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        normal_fit fit;
        const std::size_t k = ring.size();
        if (k < 2) return fit;
        const Eigen::Vector3d to_viewpoint = detail::difference(viewpoint, p);
        // The fan is closed unless it ends at a boundary; of two neighbors there is one triangle.
        const std::size_t triangles = ring.open() || k == 2 ? k - 1 : k;
        Eigen::Vector3d sum(0.0, 0.0, 0.0);
        double weights = 0.0;
        for (std::size_t j = 0; j < triangles; ++j) {
            const Eigen::Vector3d a = detail::difference(ring[j], p);
            const Eigen::Vector3d b = detail::difference(ring[j + 1 < k ? j + 1 : 0], p);
            const Eigen::Vector3d c = detail::cross(a, b);
            const double double_area = detail::length(c);
            if (double_area == 0.0) continue;
            double w = weight(a, b, double_area);
            weights += std::abs(w);
            if (sign == triangle_sign::to_viewpoint && detail::dot(c, to_viewpoint) < 0.0) w = -w;
            sum = detail::combined(1.0, sum, w / double_area, c);  // Eq. (3.9)
        }
        const double length = detail::length(sum);
        if (!std::isfinite(length)) {
            fit.trust = trust::not_finite;
            return fit;
        }
        constexpr double cancelled = 1e-12;
        if (!(length > cancelled * weights)) {
            fit.trust = trust::degenerate;
            return fit;
        }
        fit.normal = detail::scaled(1.0 / length, sum);
        fit.trust = trust::good;
        return fit;
    }
};

template <class Weight>
averaging(triangle_sign, Weight) -> averaging<Weight>;

/// All triangles alike. Gouraud 1971.
struct equal_weight {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const { return 1.0; }
};

/// The triangle's area [m^2], Eq. (3.10): the normal is that of the vector area of the fan.
struct area_weight {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, double double_area) const {
        return 0.5 * double_area;
    }
};

/// The angle [rad] at the point, Eq. (3.11), which slivers have little of.
struct angle_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double double_area) const {
        return std::atan2(double_area,
                          detail::dot(a, b));  // acos would lose half the digits near 0 and pi
    }
};

/// The inverse squared distance [1/m^2] of the triangle's centroid. Chen and Wu 2004.
struct centroid_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double) const {
        const Eigen::Vector3d sum = detail::combined(1.0, a, 1.0, b);
        return 9.0 / detail::dot(sum, sum);
    }
};

/// The pull of the triangle as a mass at its centroid: area over squared distance. The thesis names
/// the method and gives no formula; this is what the name says.
struct gravitational_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double double_area) const {
        const Eigen::Vector3d sum = detail::combined(1.0, a, 1.0, b);
        return 4.5 * double_area / detail::dot(sum, sum);
    }
};

using equally_weighted = averaging<equal_weight>;
using area_weighted = averaging<area_weight>;    ///< Eq. (3.10)
using angle_weighted = averaging<angle_weight>;  ///< Eq. (3.11)
using centroid_weighted = averaging<centroid_weight>;
using gravitationally_weighted = averaging<gravitational_weight>;

}  // namespace gnomon
