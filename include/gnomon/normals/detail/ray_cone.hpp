// SPDX-License-Identifier: BSL-1.0
/// @file
/// The cone around the rays of a sensor: that of a depth camera is narrow. (Templates, so that only
/// their users compile them.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>

namespace gnomon::detail {

/// The axis of the smallest cone around the rays, the members `ray` of some values; 0 unless all of
/// them are within 45 degrees of it. Badoiu and Clarkson 2003: steps towards the farthest ray.
[[nodiscard]] Eigen::Vector3d axis_of_cone(const auto& values) {
    Eigen::Vector3d axis(0.0, 0.0, 0.0);
    const auto farthest = [&] {
        const Eigen::Vector3d* ray = nullptr;
        double least = 2.0;
        for (const auto& s : values) {
            const double cosine = dot(s.ray, axis) / length(s.ray);
            if (cosine < least) least = cosine, ray = &s.ray;
        }
        return std::pair(ray, least);
    };
    constexpr int steps = 100;  // to about a degree
    for (int i = 1; i <= steps; ++i) {
        const auto [ray, cosine] = farthest();
        if (ray == nullptr) return axis;
        axis = combined(1.0 - 1.0 / i, axis, 1.0 / (i * length(*ray)), *ray);
        if (!has_length(axis)) return {0.0, 0.0, 0.0};
        axis = direction_of(axis);
    }
    return farthest().second > std::cos(0.785) ? axis : Eigen::Vector3d(0.0, 0.0, 0.0);
}

/// About `wanted` of the finite points of an index, drawn at random; all of fewer than twice as
/// many.
[[nodiscard]] scratch<point_index> some_points_of(const auto& index, std::size_t wanted) {
    const std::size_t thinning = std::max<std::size_t>(index.finite() / wanted, 1);
    scratch<point_index> some;
    for (std::size_t i = 0; i < index.size(); ++i)
        if (index.is_finite(i) && random_stream(i).bits() % thinning == 0)
            some.push_back(static_cast<point_index>(i));
    return some;
}

/// Whether all rays to some points of an index are within 45 degrees of one axis, as those of a
/// depth camera.
[[nodiscard]] bool is_of_camera(const auto& index, const auto& some) {
    struct ray_of_point {
        Eigen::Vector3d ray;
    };
    scratch<ray_of_point> rays;
    for (const point_index i : some) rays.push_back({difference(index[i], index.viewpoints[i])});
    return has_length(axis_of_cone(rays));
}

/// The same for some of all its points, drawn at random.
[[nodiscard]] bool is_of_camera(const auto& index) {
    constexpr std::size_t enough = 3000;  // performance only
    return is_of_camera(index, some_points_of(index, enough));
}

}  // namespace gnomon::detail
