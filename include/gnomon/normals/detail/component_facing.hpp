// SPDX-License-Identifier: BSL-1.0
/// @file
/// Which side the components of a cloud face as a whole: that of their view points, or outwards.
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

/// For each component, a number that is negative if the component should be turned as a whole.
/// component[i] is below `components`, or negative; normal_of(i) is consistent in a component.
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
    // that of |d|^2 over what it encloses, so positive if n looks outwards, whatever d = p - center
    // is counted from. The square lets the outermost points speak loudest: they look outwards even
    // where the sampling is not even. What is open and flat has no outside: it faces up.
    const Eigen::Vector3d faintly_up(1e-12, 1e-10, 1e-8);
    for_each_point([&](std::size_t c, std::size_t i) {
        const double scale = radius[c] > 0.0 ? 1.0 / radius[c] : 0.0;
        const Eigen::Vector3d d = scaled(scale, difference(p[i], center[c]));
        vote[c] += dot(normal_of(i), combined(dot(d, d), d, 1.0, faintly_up));
    });
    return vote;
}

}  // namespace gnomon::detail
