// SPDX-License-Identifier: BSL-1.0
/// @file
/// The two steps of `feature_preserving` that use the surfaces of the neighbors: the selection of
/// the surface that fits a point best, its own or a neighbor's, and the bilateral mean of the
/// normals that the neighbors' surfaces have at the point.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/symmetric_eigen.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/detail/weighted_moments.hpp>
#include <gnomon/core/moments.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/normals/detail/local_surface.hpp>
#include <gnomon/normals/plane_fit.hpp>

namespace gnomon::detail {

/// (1 - x / 16)^16, within 0.018 below exp(-x), and 0 from x = 16 on: five multiplications instead
/// of an exponential (performance only).
[[nodiscard]] inline double decay(double x) {
    double power = std::max(0.0, 1.0 - x / 16.0);
    for (int i = 0; i < 4; ++i) power *= power;
    return power;
}

/// About exp(-d^2 / 2) of a distance d in standard deviations.
[[nodiscard]] inline double gaussian(double d) { return decay(0.5 * d * d); }

/// Among the surfaces of a point and of its first k neighbors, the one that the point and most of
/// its neighbors lie on. Near an edge it is the surface of a neighbor whose own neighborhood does
/// not cross the edge: a shifted neighborhood (Cao et al. 2018). Precondition: that of the point
/// itself is usable.
/// @param surfaces   those of all points
/// @param deviation  standard deviation of points from their surface [m]
[[nodiscard]] local_surface best_surface(const surroundings& around, std::size_t k,
                                         const auto& surfaces, double deviation) {
    constexpr std::size_t candidates = 24,
                          samples = 32;  // of a large neighborhood: performance only
    const std::size_t each_candidate = std::max<std::size_t>(1, k / candidates);
    const std::size_t each_sample = std::max<std::size_t>(1, k / samples);
    const auto most = static_cast<double>(k / each_sample + 1);
    std::size_t best = 0;
    double best_score = -1.0;
    for (std::size_t a = 0; a <= k; a += each_candidate) {
        const local_surface& s = surfaces[around.index[a]];
        if (!usable(s.fit.trust)) continue;
        const Eigen::Vector3d& at = around.offset[a];
        const double own = gaussian(s.residual(scaled(-1.0, at)) / deviation);
        if (own * most <= best_score) continue;
        double all = 0.0;
        for (std::size_t l = 0; l <= k; l += each_sample)
            all += gaussian(s.residual(difference(around.offset[l], at)) / deviation);
        if (own * all > best_score) {
            best_score = own * all;
            best = a;
        }
    }
    return surfaces[around.index[best]].seen_from(scaled(-1.0, around.offset[best]));
}

/// The surface refitted to the first k neighbors by iteratively reweighted least squares.
/// @param around     a `surroundings`
/// @param deviation  distance from the surface at which the weight is exp(-1/2) [m]
[[nodiscard]] local_surface refitted(const auto& around, std::size_t k, local_surface surface,
                                     double deviation, double min_aspect_ratio) {
    constexpr int rounds = 3;  // chosen on the tuning half of known_normals
    const double scale = 1.0 / around.radius(k);
    for (int i = 0; i < rounds; ++i) {
        weighted_moments m;
        least_squares_quadric heights;
        const tangent_basis& base = surface.base;
        for (std::size_t l = 0; l <= k; ++l) {
            const Eigen::Vector3d& x = around.offset[l];
            const double weight = gaussian(surface.residual(x) / deviation);
            m.add(x, weight);
            if (surface.curved) add_height(heights, base, scale, x, weight);
        }
        if (!(m.weight > 0.0)) break;
        const plane_fit fit = plane_of_least_spread(m.covariance(), min_aspect_ratio);
        if (!usable(fit.trust)) break;
        if (surface.curved) {
            if (!(heights.solve() > local_fits::least_independence)) break;
            surface.fit = fit;
            surface.become(heights.solution(scale, scale));
        } else {
            surface.become(fit, dot(fit.normal, m.mean()));
        }
    }
    return surface;
}

/// The mean of the normals that the surfaces of a point and of its first k neighbors have at the
/// point, as axes without sign: a bilateral filter. The weights decrease with the distance, with
/// the angle between the normals, and with the distances of the points from each other's surfaces,
/// so that normals beyond an edge or on a parallel wall have almost no weight. Precondition: the
/// surface of the point itself is usable.
/// @param surfaces   those of all points
/// @param deviation  standard deviation of points from each other's surfaces [m]
[[nodiscard]] Eigen::Vector3d filtered_normal(const surroundings& around, std::size_t k,
                                              const auto& surfaces, double deviation) {
    // Chosen on the tuning half of known_normals.
    constexpr double agreement = 0.6;  // standard deviation of the sine of the angle
    constexpr double nearness = 0.5;   // standard deviation of the distance, in radii
    const local_surface& own = surfaces[around.index[0]];
    const double radius = around.radius(k);
    weighted_moments axes;
    for (std::size_t l = 0; l <= k; ++l) {
        const local_surface& other = surfaces[around.index[l]];
        if (!usable(other.fit.trust)) continue;
        const Eigen::Vector3d& x = around.offset[l];
        const Eigen::Vector3d back = scaled(-1.0, x);
        const Eigen::Vector3d normal = other.normal_at(back);
        const double cosine = dot(own.fit.normal, normal);
        const double here = own.residual(x) / deviation;
        const double there = other.residual(back) / deviation;
        const double distant = length(x) / (nearness * radius);
        const double unlike = (1.0 - cosine * cosine) / (agreement * agreement) +
                              0.5 * (here * here + there * there) + distant * distant;
        axes.add(normal, decay(0.5 * unlike));
    }
    if (!(axes.weight > 0.0)) return own.fit.normal;  // an outlier
    return column(symmetric_eigen(axes.second_moments()).vectors, 0);
}

}  // namespace gnomon::detail
