// SPDX-License-Identifier: BSL-1.0
/// @file
/// Averaging methods: the normal is the weighted mean of the normals of the triangles that a point
/// forms with consecutive neighbors.
///
/// The k nearest neighbors are sorted by distance, so that consecutive triangles have either
/// orientation and their normals cancel. The thesis states good results for such neighborhoods;
/// they require a common sign of all triangles (`triangle_sign::to_viewpoint`) or an angular order
/// of the neighbors (`delaunay`, `angularly_sorted`).
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

/// How the sign of each triangle's normal is chosen.
enum class triangle_sign : bool {
    from_order,   ///< the order of the two neighbors, as in the thesis
    to_viewpoint  ///< every normal is on the side of the view point
};

namespace detail {

/// The weight of a triangle (p, p + a, p + b) whose area is not zero, from the offsets a and b of
/// the two neighbors [m] and |a x b| [m^2].
template <class W>
concept triangle_weight = requires(const W& weight, const Eigen::Vector3d& a, double double_area) {
    { weight(a, a, double_area) } -> std::convertible_to<double>;
};

/// The same weight for all triangles. Gouraud 1971.
struct equal_weight {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, double) const { return 1.0; }
};

/// The area of the triangle [m^2], Eq. (3.10): the normal is that of the vector area of the fan.
struct area_weight {
    double operator()(const Eigen::Vector3d&, const Eigen::Vector3d&, double double_area) const {
        return 0.5 * double_area;
    }
};

/// The angle of the triangle at the point [rad], Eq. (3.11), which is small for sliver triangles.
struct angle_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double double_area) const {
        return std::atan2(double_area, dot(a, b));  // acos loses half the digits near 0 and pi
    }
};

/// The inverse squared distance of the triangle's centroid from the point [1/m^2]. Chen and Wu
/// 2004.
struct centroid_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b, double) const {
        const Eigen::Vector3d sum = combined(1.0, a, 1.0, b);
        return 9.0 / dot(sum, sum);
    }
};

/// The area of the triangle divided by the squared distance of its centroid: the gravitation of a
/// mass there. The thesis names the method without a formula.
struct gravitational_weight {
    double operator()(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      double double_area) const {
        const Eigen::Vector3d sum = combined(1.0, a, 1.0, b);
        return 4.5 * double_area / dot(sum, sum);
    }
};

/// Models `ray_estimator` and `cyclic_estimator`. Needs two neighbors. O(k).
///
/// Trust: `degenerate` where all triangles have no area, or where their normals cancel to less than
/// 1e-12 of their weights (rounding).
///
/// @tparam Weight  weight(a, b, double_area) is the weight of the triangle (p, p + a, p + b) whose
///                 area is not zero: a and b are the offsets of the two neighbors [m], double_area
///                 is |a x b| [m^2]
template <triangle_weight Weight>
struct averaging {
    static constexpr auto sensitive_to = sensitivity::order;
    static constexpr bool reads_fan = true;

    triangle_sign sign = triangle_sign::from_order;
    [[no_unique_address]] Weight weight = {};

    [[nodiscard]] normal_fit operator()(const Eigen::Vector3d& p, neighborhood_view neighbors,
                                        const Eigen::Vector3d& viewpoint = {0.0, 0.0, 0.0}) const {
        normal_fit fit;
        const std::size_t k = neighbors.size();
        if (k < 2) return fit;
        const Eigen::Vector3d to_viewpoint = detail::difference(viewpoint, p);
        // The fan is closed unless it ends at a boundary; two neighbors form one triangle.
        const std::size_t triangles = neighbors.open() || k == 2 ? k - 1 : k;
        Eigen::Vector3d sum(0.0, 0.0, 0.0);
        double weights = 0.0;
        for (std::size_t j = 0; j < triangles; ++j) {
            const Eigen::Vector3d a = detail::difference(neighbors[j], p);
            const Eigen::Vector3d b = detail::difference(neighbors[j + 1 < k ? j + 1 : 0], p);
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

}  // namespace detail

using equally_weighted = detail::averaging<detail::equal_weight>;      ///< the same for all
using area_weighted = detail::averaging<detail::area_weight>;          ///< Eq. (3.10)
using angle_weighted = detail::averaging<detail::angle_weight>;        ///< Eq. (3.11)
using centroid_weighted = detail::averaging<detail::centroid_weight>;  ///< Chen and Wu 2004
/// By area over the squared distance of the centroid.
using gravitationally_weighted = detail::averaging<detail::gravitational_weight>;

}  // namespace gnomon
