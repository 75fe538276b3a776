// SPDX-License-Identifier: BSL-1.0
/// @file
/// The box around points along given axes, and its refinement: of all boxes that share an axis with
/// it the smallest is that of the smallest rectangle around the points, seen along this axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/features/detail/planar_hull.hpp>
#include <gnomon/features/detail/smallest_rectangle.hpp>
#include <gnomon/neighborhoods/detail/delaunay_star.hpp>

namespace gnomon::detail {

/// The smallest box with the given axes around points.
struct box_fit {
    std::array<Eigen::Vector3d, 3> axes;    ///< orthogonal unit vectors
    std::array<std::uint32_t, 3> lowest{};  ///< the points on its faces
    std::array<std::uint32_t, 3> highest{};
    std::array<double, 3> low{};
    std::array<double, 3> high{};
    double volume = 1.0;

    /// O(n) for n points, at least one.
    box_fit(std::span<const Eigen::Vector3d> points, const std::array<Eigen::Vector3d, 3>& along)
        : axes(along) {
        for (std::size_t a = 0; a < 3; ++a) {
            low[a] = high[a] = dot(axes[a], points[0]);
            for (std::uint32_t i = 1; i < points.size(); ++i) {
                const double x = dot(axes[a], points[i]);
                if (x < low[a]) {
                    low[a] = x;
                    lowest[a] = i;
                }
                if (x > high[a]) {
                    high[a] = x;
                    highest[a] = i;
                }
            }
            volume *= size(a);
        }
    }

    /// The length along axis a.
    [[nodiscard]] double size(std::size_t a) const { return high[a] - low[a]; }
    /// The axis of the smallest length.
    [[nodiscard]] std::size_t thinnest() const {
        std::size_t best = 0;
        for (std::size_t a = 1; a < 3; ++a)
            if (size(a) < size(best)) best = a;
        return best;
    }
};

/// The smallest box with one of the axes of another.
[[nodiscard]] inline box_fit turned_about(const box_fit& box, std::size_t axis,
                                          std::span<const Eigen::Vector3d> points) {
    const Eigen::Vector3d& x = box.axes[(axis + 1) % 3];
    const Eigen::Vector3d& y = box.axes[(axis + 2) % 3];
    std::vector<planar_point> projected(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        projected[i] = {dot(x, points[i]), dot(y, points[i]), i};
    std::vector<Eigen::Vector2d> outline;
    for (const planar_point& p : planar_hull(std::move(projected))) outline.emplace_back(p.x, p.y);
    const planar_rectangle r = smallest_rectangle(outline);
    return {points, {box.axes[axis], combined(r.c, x, r.s, y), combined(-r.s, x, r.c, y)}};
}

/// Turns a box about its axes in turn until it grows no smaller.
[[nodiscard]] inline box_fit refined(box_fit box, std::span<const Eigen::Vector3d> points) {
    constexpr double gain = 1.0 - 1e-9;  // numerical: convergence
    for (std::size_t axis = 0, unchanged = 0; unchanged < 3; axis = (axis + 1) % 3) {
        const box_fit turned = turned_about(box, axis, points);
        if (turned.volume < gain * box.volume) {
            box = turned;
            unchanged = 0;
            axis = 0;  // the axis turned about is the first now
        } else {
            ++unchanged;
        }
    }
    return box;
}

}  // namespace gnomon::detail
