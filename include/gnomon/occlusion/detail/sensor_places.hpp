// SPDX-License-Identifier: BSL-1.0
/// @file
/// The places of a moving sensor: view points nearer to each other than the standard deviation of
/// the ranges are one place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon::detail {

/// What was seen from the view points in a cube, and their mean [m].
struct sensor_place {
    scratch<point_index> seen;
    Eigen::Vector3d viewpoint;
};

/// The finite points by their view points, as far as these are finite, in cubes of size sigma [m],
/// the first about the least of them. O(n log v) for v cubes; those of a scan line are in one.
/// @param points  a position_view
[[nodiscard]] scratch<sensor_place> places_of_sensor(const auto& points,
                                                     const viewpoint_table& viewpoints,
                                                     double sigma) {
    constexpr double exact = 1e-6;  // [m]: below, each view point is one
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Eigen::Vector3d least(infinity, infinity, infinity), before = least;
    for (const Eigen::Vector3d& v : viewpoints.positions())
        for (int a = 0; a < 3 && is_finite(v); ++a) least[a] = std::min(least[a], v[a]);
    using cube = std::array<double, 3>;
    using seen_from_cube = std::pair<const cube, scratch<point_index>>;
    std::map<cube, scratch<point_index>, std::less<>, pooled<seen_from_cube>> cubes;
    scratch<point_index>* latest = nullptr;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const Eigen::Vector3d v = viewpoints[i];
        if (!is_finite(points[i]) || !is_finite(v)) continue;
        if (v != before) {
            cube own;
            for (int a = 0; a < 3; ++a)
                own[a] = sigma < exact ? v[a] : std::round((v[a] - least[a]) / sigma);
            latest = &cubes[own];
            before = v;
        }
        latest->push_back(static_cast<point_index>(i));
    }
    scratch<sensor_place> places;
    for (auto& [own, seen] : cubes) {
        const Eigen::Vector3d first = viewpoints[seen.front()];
        Eigen::Vector3d ways(0.0, 0.0, 0.0);  // the sum of those to the others
        for (const point_index i : seen)
            ways = combined(1.0, ways, 1.0, difference(viewpoints[i], first));
        const auto count = static_cast<double>(seen.size());
        places.push_back({std::move(seen), combined(1.0, first, 1.0 / count, ways)});
    }
    return places;
}

}  // namespace gnomon::detail
