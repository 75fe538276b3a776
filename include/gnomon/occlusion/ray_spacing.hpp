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
#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// The direction in which a point is seen.
struct cloud_ray {
    Eigen::Vector3d direction;  ///< of unit length, or zero for none
    point_index point;
    std::uint64_t number;  ///< by which it is drawn
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

/// The rays to all points, missing ones among them.
template <execution X>
[[nodiscard]] scratch<cloud_ray> rays_of(const auto& points, const viewpoint_table& viewpoints,
                                         const X& run) {
    scratch<cloud_ray> rays;
    resize_touched(rays, points.size(), run);
    for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const Eigen::Vector3d way = difference(points[i], viewpoints[i]);
            const bool has_one = has_length(way);  // nor have those one that are not finite
            const Eigen::Vector3d direction =
                scaled(has_one ? 1.0 / length(way) : 0.0, has_one ? way : Eigen::Vector3d(0, 0, 0));
            rays[i] = {direction, static_cast<point_index>(i), drawn_number(direction)};
        }
    });
    return rays;
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
        const std::uint64_t number = r.number;
        if ((drawn.size() == count && number > numbers.back()) || is_missing(r.direction)) continue;
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

/// A ray and the squares of the angles, as chords, to the N nearest ones, ascending [rad^2].
template <std::size_t N>
struct ray_with_nearest {
    cloud_ray ray;
    double parallax;  ///< of the view points of rays that count [rad]
    std::array<double, N> nearest;

    void compare(const cloud_ray& r, const auto& points, const viewpoint_table& viewpoints) {
        const double up = ray.direction[2] - r.direction[2];
        if (up * up >= nearest.back()) return;  // performance only
        const double squared = squared_distance(ray.direction, r.direction);
        // From where the point of a seed is seen in nearly the same direction, rays count:
        // stations apart do not see more finely by being many, the lines of a moving sensor do.
        const Eigen::Vector3d v = viewpoints[ray.point];
        if (squared >= nearest.back() ||
            squared_distance(v, viewpoints[r.point]) >
                parallax * parallax * squared_distance(v, points[ray.point]))
            return;
        const auto last = nearest.end() - 1;
        *last = squared;
        std::rotate(std::upper_bound(nearest.begin(), last, squared), last, nearest.end());
    }
};

/// The spacing of the rays of a cloud [rad]: the side of the square of directions that each of the
/// 16 nearest rays has for itself, the median over rays. From 32 rays, drawn by a hash of their
/// directions, so that the result does not depend on the order of the points; O(n).
/// @param points  a position_view
template <execution X>
[[nodiscard]] angle ray_spacing(const auto& points, const viewpoint_table& viewpoints,
                                const X& run) {
    constexpr std::size_t neighbors = 16;  // chosen: the spacing is known to an eighth
    constexpr std::size_t seeds = 32;      // performance only
    // [rad]; numerical: limits of the result, which bound the pixels of an image and the rays to
    // compare
    constexpr double least = std::numbers::pi / 3600, most = std::numbers::pi / 36;
    const scratch<cloud_ray> rays = rays_of(points, viewpoints, run);
    using seed = ray_with_nearest<neighbors + 1>;  // itself and its nearest rays
    scratch<seed> drawn;
    // 16 rays within the largest angle are `most` apart.
    for (const cloud_ray& r : drawn_rays(rays, seeds, points, viewpoints))
        drawn.emplace_back(seed{r, most, {}})
            .nearest.fill(most * most * neighbors / std::numbers::pi);
    if (drawn.empty()) return radians(most);
    constexpr std::size_t together = 8;  // seeds that pass over the rays at once; performance only
    run((drawn.size() + together - 1) / together, [&](std::size_t part) {
        const auto begin = drawn.begin() + static_cast<std::ptrdiff_t>(part * together);
        const auto end = begin + std::min<std::ptrdiff_t>(together, drawn.end() - begin);
        for (const cloud_ray& r : rays)
            for (auto s = begin; s != end; ++s) s->compare(r, points, viewpoints);
    });
    const auto at = drawn.begin() + static_cast<std::ptrdiff_t>(drawn.size() / 2);
    std::nth_element(drawn.begin(), at, drawn.end(), [](const seed& a, const seed& b) {
        return a.nearest.back() < b.nearest.back();
    });
    return radians(
        std::clamp(std::sqrt(at->nearest.back() * std::numbers::pi / neighbors), least, most));
}

}  // namespace gnomon::detail
