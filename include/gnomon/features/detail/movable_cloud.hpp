// SPDX-License-Identifier: BSL-1.0
/// @file
/// The points that `align_to_surface` moves, relative to the centroid of those near the surface.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
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
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// A point to align, relative to the centroid, in its own frame.
struct movable_point {
    Eigen::Vector3d at;
    Eigen::Vector3d ray;     ///< unit vector from its view point; zero where that is unknown
    Eigen::Vector3d normal;  ///< unit vector; zero where it is missing
    double variance;         ///< of its noise, along the ray or in all directions [m^2]
};

/// Whether a point is nearer to the box of a surface than its diagonal and a distance: others are
/// too far off to correspond to a sample.
/// @param x  in the frame of the surface [m]
[[nodiscard]] inline bool is_near_surface(const spatial_index& surface, const Eigen::Vector3d& x,
                                          double distance) {
    if (surface.tree().size() == 0) return false;
    const leaf_box& box = surface.tree().box();
    const std::array<double, 3> at{x[0], x[1], x[2]};
    const double reach = distance + std::sqrt(box.squared_diagonal());
    return box.squared_distance_to({at, at}) <= reach * reach;
}

/// The finite ones of the points to align.
struct movable_cloud {
    scratch<movable_point> points;
    scratch<movable_point> sample;  ///< some 400 of more than twice as many points
    /// Of the points near the surface at the start, or else of all: those far off do not count, as
    /// they determine nothing [m].
    Eigen::Vector3d centroid{0.0, 0.0, 0.0};
    double lever = 1.0;    ///< their root mean square distance from it [m]
    double largest = 0.0;  ///< coordinate [m]

    /// @param normals  (i): the normal of point i, zero or not finite if it is missing
    /// @param is_near  (x): whether a point is near the surface at the start
    template <class R, class Proj>
    movable_cloud(const R& range, auto&& normals, const noise_curve& noise, const auto& is_near,
                  Proj projection) {
        const position_view<R, Proj> p(range, std::move(projection));
        with_table_of(range, [&](const viewpoint_table& viewpoints) {
            points.reserve(p.size());
            const Eigen::Vector3d first = first_of(p, is_near);
            scratch<point_index> nearby;
            for (std::size_t i = 0; i < p.size(); ++i) {
                const Eigen::Vector3d x = p[i];
                if (!is_finite(x)) continue;
                const Eigen::Vector3d v = viewpoints[i], n = normals(i);
                const Eigen::Vector3d way = is_finite(v) ? difference(x, v) : x;
                movable_point m{
                    difference(x, first), {0, 0, 0}, {0, 0, 0}, noise.variance_along(way)};
                if (!viewpoints.empty() && is_finite(v) && has_length(way))
                    m.ray = direction_of(way);
                if (all_finite(n) && has_length(n)) m.normal = direction_of(n);
                if (is_near(x)) nearby.push_back(static_cast<point_index>(points.size()));
                points.push_back(m);
            }
            if (points.empty()) return;
            const bool all = nearby.empty();
            const std::size_t counted = all ? points.size() : nearby.size();
            const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
                return points[all ? k : nearby[k]].at;
            };
            Eigen::Vector3d sum(0.0, 0.0, 0.0);
            for (std::size_t k = 0; k < counted; ++k) {
                sum = combined(1.0, sum, 1.0, at(k));
                for (int a = 0; a < 3; ++a)
                    largest = std::max(largest, std::abs(first[a] + at(k)[a]));
            }
            const double share = 1.0 / static_cast<double>(counted);
            const Eigen::Vector3d mean = scaled(share, sum);
            centroid = combined(1.0, first, 1.0, mean);
            for (movable_point& m : points) m.at = difference(m.at, mean);
            double squares = 0.0;
            for (std::size_t k = 0; k < counted; ++k) squares += share * dot(at(k), at(k));
            if (squares > 0.0) lever = std::sqrt(squares);
            const double n = static_cast<double>(points.size());
            constexpr double enough = 400.0;  // performance only
            random_stream random(0);
            if (n > 2.0 * enough) {
                for (const movable_point& m : points)
                    if (random.uniform() * n < enough) sample.push_back(m);
            }
        });
    }

  private:
    /// The first point near the surface, or else the first finite one: the others are stored
    /// relative to it.
    [[nodiscard]] static Eigen::Vector3d first_of(const auto& points, const auto& is_near) {
        std::optional<Eigen::Vector3d> first;
        for (std::size_t i = 0; i < points.size(); ++i) {
            const Eigen::Vector3d x = points[i];
            if (!is_finite(x)) continue;
            if (is_near(x)) return x;
            if (!first) first = x;
        }
        return first.value_or(Eigen::Vector3d(0.0, 0.0, 0.0));
    }
};

}  // namespace gnomon::detail
