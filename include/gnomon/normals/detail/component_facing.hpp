// SPDX-License-Identifier: BSL-1.0
/// @file
/// The sign of consistently oriented components of a cloud: towards their view points, or, without
/// view points, outwards.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// For each component, a number that is negative if the normals of the component are to be negated.
/// component[i] is the component of point i, below `components`, or negative if it has none;
/// normal_of(i) is oriented consistently within a component.
template <class Points>
[[nodiscard]] std::vector<double> component_facing(const Points& p,
                                                   const viewpoint_table& viewpoints,
                                                   auto&& normal_of,
                                                   const std::vector<std::int32_t>& component,
                                                   std::size_t components) {
    std::vector<double> vote(components, 0.0);
    const auto for_each_point = [&](auto&& work) {
        for (std::size_t i = 0; i < p.size(); ++i) {
            if (component[i] >= 0) work(static_cast<std::size_t>(component[i]), i);
        }
    };
    if (!viewpoints.empty()) {
        for_each_point([&](std::size_t c, std::size_t i) {
            const Eigen::Vector3d view = viewpoints[i];
            require(is_finite(view), "propagate_orientation: a view point is not finite");
            const double range = std::sqrt(squared_distance(view, p[i]));
            if (range > 0.0) vote[c] += dot(normal_of(i), difference(view, p[i])) / range;
        });
        return vote;
    }
    std::vector<double> count(components, 0.0);
    std::vector<double> radius(components, 0.0);
    std::vector<Eigen::Vector3d> center(components, Eigen::Vector3d(0.0, 0.0, 0.0));
    for_each_point([&](std::size_t c, std::size_t) { ++count[c]; });
    for_each_point([&](std::size_t c, std::size_t i) {
        center[c] = combined(1.0, center[c], 1.0 / count[c], p[i]);
    });
    for_each_point([&](std::size_t c, std::size_t i) {
        radius[c] = std::max(radius[c], std::sqrt(squared_distance(p[i], center[c])));
    });
    // By the divergence theorem, the integral of <n, d> |d|^2 over a closed surface is five times
    // the integral of |d|^2 over the enclosed volume, for any center of d = p - center: it is
    // positive if n points outwards. The factor |d|^2 gives the outermost points the largest
    // weight; their sign is right also where the sampling density varies. An open and flat
    // component has no outside: its normals point up.
    const Eigen::Vector3d faintly_up(1e-12, 1e-10, 1e-8);
    for_each_point([&](std::size_t c, std::size_t i) {
        const double scale = radius[c] > 0.0 ? 1.0 / radius[c] : 0.0;
        const Eigen::Vector3d d = scaled(scale, difference(p[i], center[c]));
        vote[c] += dot(normal_of(i), combined(dot(d, d), d, 1.0, faintly_up));
    });
    return vote;
}

}  // namespace gnomon::detail
