// SPDX-License-Identifier: BSL-1.0
/// @file
/// The symmetry of a surface about a vertical axis, measured on samples of it. The poses of a
/// symmetric object are known only up to these turns.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::recognition {

/// The turns about a vertical axis under which a surface is the same.
struct vertical_symmetry {
    static constexpr int any_turn = 0;  ///< a surface of revolution

    int order = 1;            ///< multiples of 360 degrees / order; 1 for none, or `any_turn`
    double x = 0.0, y = 0.0;  ///< of the axis [m]

    /// A turn about the axis, as a motion of the surface's frame.
    [[nodiscard]] rigid_motion turn(angle by) const {
        return rigid_motion::on_ground(x, y, by) * rigid_motion::on_ground(-x, -y, degrees(0.0));
    }

    /// The difference of two yaws up to symmetry: 0 for any turn, else in [0, 180 / order] degrees.
    [[nodiscard]] angle difference(angle a, angle b) const {
        if (order == any_turn) return degrees(0.0);
        const double period = 2.0 * std::numbers::pi / order;
        return radians(std::abs(std::remainder(a.radians() - b.radians(), period)));
    }
};

namespace detail {

/// The share of samples that have, after a turn, a sample of a similar normal near them.
template <class Normals>
[[nodiscard]] double mapped_share(const spatial_index& samples, const Normals& normals,
                                  const rigid_motion& turn, double tolerance) {
    constexpr double similar = 0.8;  // chosen: cosine of 37 degrees
    constexpr std::size_t most = 12;
    std::vector<neighbor> found;
    std::size_t mapped = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Eigen::Vector3d n = turn.direction_out(normals[i].normal);
        samples.nearest_within_into(found, turn.point_out(samples[i]), most, tolerance);
        mapped += std::any_of(found.begin(), found.end(), [&](const neighbor& q) {
            return gnomon::detail::dot(n, normals[q.index].normal) > similar;
        });
    }
    return static_cast<double>(mapped) / static_cast<double>(samples.size());
}

}  // namespace detail

/// Measures the symmetry of a surface: orders from 8 down are tried, and what has each of the
/// orders 5, 7 and 8 is a surface of revolution. The axis passes through the centroid of the
/// samples.
/// @param spacing  of the samples; 1.5 of these is the tolerance [m]
/// Complexity: O(n log n) for n samples.
template <normal_range Normals>
[[nodiscard]] vertical_symmetry measure_symmetry(const spatial_index& samples,
                                                 const Normals& normals, double spacing) {
    vertical_symmetry s;
    if (samples.size() == 0) return s;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const Eigen::Vector3d p = samples[i];
        s.x += p.x() / static_cast<double>(samples.size());
        s.y += p.y() / static_cast<double>(samples.size());
    }
    constexpr double enough = 0.98;   // chosen on furniture_models(): of .5 to .97 without symmetry
    constexpr double spacings = 1.5;  // chosen: two samples of a surface are at most this apart
    const auto has = [&](int order) {
        const angle by = degrees(360.0 / order);
        return detail::mapped_share(samples, normals, s.turn(by), spacings * spacing) >= enough;
    };
    constexpr int most = 8;
    if (has(5) && has(7) && has(8)) {
        s.order = vertical_symmetry::any_turn;
        return s;
    }
    for (int order = most; order > 1; --order) {
        if (!has(order)) continue;
        s.order = order;
        return s;
    }
    return s;
}

}  // namespace gnomon::recognition
