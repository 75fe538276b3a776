// SPDX-License-Identifier: BSL-1.0
/// @file
/// How far apart the rays of a cloud are, for range images of clouds whose sensor is not known.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <tuple>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// The direction in which a point is seen.
struct cloud_ray {
    Eigen::Vector3d direction;
    point_index point;
};

/// As good as random, of a direction by a microradian: the same wherever the cloud lies.
[[nodiscard]] inline std::uint64_t drawn_number(const Eigen::Vector3d& direction) {
    constexpr double steps = 1e6;  // of 1 (numerical)
    constexpr int bits = 21;       // for all steps from -1 to 1 (formula)
    std::int64_t all = 0;
    for (int a = 0; a < 3; ++a)
        all = all << bits | static_cast<std::int64_t>((direction[a] + 1.0) * steps + 0.5);
    return random_stream(static_cast<std::uint64_t>(all)).bits();
}

/// Some of the rays, of different directions, drawn by their numbers: the same in whatever order
/// the points are stored, which may well be as regular as any other way to draw them.
[[nodiscard]] scratch<cloud_ray> drawn_rays(const scratch<cloud_ray>& rays, std::size_t count,
                                            const auto& points, const viewpoint_table& viewpoints) {
    const auto key = [&](const cloud_ray& r) {
        const Eigen::Vector3d v = viewpoints[r.point];
        return std::tuple(squared_distance(points[r.point], v), v[0], v[1], v[2]);
    };
    scratch<std::uint64_t> numbers;  // ascending
    scratch<cloud_ray> drawn;
    for (const cloud_ray& r : rays) {
        const std::uint64_t number = drawn_number(r.direction);
        if (drawn.size() == count && number > numbers.back()) continue;
        const auto at = std::lower_bound(numbers.begin(), numbers.end(), number);
        const auto place = drawn.begin() + (at - numbers.begin());
        if (at != numbers.end() && *at == number) {
            if (key(r) < key(*place)) *place = r;
            continue;
        }
        numbers.insert(at, number);
        drawn.insert(place, r);
        numbers.resize(std::min(numbers.size(), count));
        drawn.resize(numbers.size());
    }
    return drawn;
}

/// The spacing of the rays of a cloud [rad]: the side of the square of directions that each of the
/// 16 nearest rays has for itself, the median over rays. From 32 rays, drawn by a hash of their
/// directions, so that the result does not depend on the order of the points; O(n).
/// @param points  a position_view
[[nodiscard]] angle ray_spacing(const auto& points, const viewpoint_table& viewpoints) {
    constexpr std::size_t neighbors = 16;  // chosen: the spacing is known to an eighth
    constexpr std::size_t seeds = 32;      // performance only
    // [rad]; numerical: limits of the result, which bound the pixels of an image and the rays to
    // compare
    constexpr double least = std::numbers::pi / 3600, most = std::numbers::pi / 36;
    scratch<cloud_ray> rays;
    rays.reserve(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d way = difference(points[i], viewpoints[i]);
        if (has_length(way))  // nor do those have one that are not finite
            rays.push_back({scaled(1.0 / length(way), way), static_cast<point_index>(i)});
    }
    if (rays.empty()) return radians(most);
    // The squares of the angles, as chords, from each seed to itself and its nearest rays [rad^2];
    // 16 rays within the largest are `most` apart.
    struct seed {
        cloud_ray ray;
        std::array<double, neighbors + 1> nearest;
    };
    scratch<seed> drawn;
    for (const cloud_ray& r : drawn_rays(rays, seeds, points, viewpoints))
        drawn.emplace_back(seed{r, {}}).nearest.fill(most * most * neighbors / std::numbers::pi);
    for (const cloud_ray& r : rays) {
        for (auto& [s, nearest] : drawn) {
            const double up = s.direction[2] - r.direction[2];
            if (up * up >= nearest.back()) continue;  // performance only
            const double squared = squared_distance(s.direction, r.direction);
            // From where the point of a seed is seen in nearly the same direction, rays count:
            // stations apart do not see more finely by being many, the lines of a moving sensor do.
            const Eigen::Vector3d v = viewpoints[s.point];
            if (squared >= nearest.back() || squared_distance(v, viewpoints[r.point]) >
                                                 most * most * squared_distance(v, points[s.point]))
                continue;
            const auto last = nearest.end() - 1;
            *last = squared;
            std::rotate(std::upper_bound(nearest.begin(), last, squared), last, nearest.end());
        }
    }
    const auto at = drawn.begin() + static_cast<std::ptrdiff_t>(drawn.size() / 2);
    std::nth_element(drawn.begin(), at, drawn.end(), [](const seed& a, const seed& b) {
        return a.nearest.back() < b.nearest.back();
    });
    return radians(
        std::clamp(std::sqrt(at->nearest.back() * std::numbers::pi / neighbors), least, most));
}

}  // namespace gnomon::detail
