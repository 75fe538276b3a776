// SPDX-License-Identifier: BSL-1.0
/// @file
/// The points that `align_to_surface` moves, relative to their centroid.
#pragma once

#include <algorithm>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// A point to align, relative to the centroid of all, in its own frame.
struct movable_point {
    Eigen::Vector3d at;
    Eigen::Vector3d ray;     ///< unit vector from its view point; zero where that is unknown
    Eigen::Vector3d normal;  ///< unit vector; zero where it is missing
    double variance;         ///< of its noise, along the ray or in all directions [m^2]
};

/// The finite ones of the points to align.
struct movable_cloud {
    scratch<movable_point> points;
    scratch<movable_point> sample;            ///< some 400 of more than twice as many points
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};  ///< [m]
    double lever = 1.0;                       ///< root mean square distance from it [m]
    double largest = 0.0;                     ///< coordinate [m]

    /// @param normals  (i): the normal of point i, zero or not finite if it is missing
    template <class R, class Proj>
    movable_cloud(const R& range, auto&& normals, const noise_curve& noise, Proj projection) {
        const position_view<R, Proj> p(range, std::move(projection));
        with_table_of(range, [&](const viewpoint_table& viewpoints) {
            points.reserve(p.size());
            Eigen::Vector3d first{0.0, 0.0, 0.0}, sum = first;
            for (std::size_t i = 0; i < p.size(); ++i) {
                const Eigen::Vector3d x = p[i];
                if (!is_finite(x)) continue;
                if (points.empty()) first = x;
                const Eigen::Vector3d v = viewpoints[i], n = normals(i);
                const Eigen::Vector3d way = is_finite(v) ? difference(x, v) : x;
                movable_point m{
                    difference(x, first), {0, 0, 0}, {0, 0, 0}, noise.variance_along(way)};
                if (!viewpoints.empty() && is_finite(v) && has_length(way))
                    m.ray = direction_of(way);
                if (all_finite(n) && has_length(n)) m.normal = direction_of(n);
                sum = combined(1.0, sum, 1.0, m.at);
                for (int a = 0; a < 3; ++a) largest = std::max(largest, std::abs(x[a]));
                points.push_back(m);
            }
            if (points.empty()) return;
            const double n = static_cast<double>(points.size());
            const Eigen::Vector3d mean = scaled(1.0 / n, sum);
            centroid = combined(1.0, first, 1.0, mean);
            double squares = 0.0;
            for (movable_point& m : points) {
                m.at = difference(m.at, mean);
                squares += dot(m.at, m.at) / n;
            }
            if (squares > 0.0) lever = std::sqrt(squares);
            constexpr double enough = 400.0;  // performance only
            random_stream random(0);
            if (n > 2.0 * enough) {
                for (const movable_point& m : points)
                    if (random.uniform() * n < enough) sample.push_back(m);
            }
        });
    }
};

}  // namespace gnomon::detail
