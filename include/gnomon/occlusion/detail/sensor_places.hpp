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

/// View points of a cube, and what was seen from there.
struct sensor_place {
    scratch<point_index> seen = {};
    Eigen::Vector3d first{0.0, 0.0, 0.0};    // view point [m]
    Eigen::Vector3d from_it{0.0, 0.0, 0.0};  // the sum of the ways to the others [m]

    void add(point_index i, const Eigen::Vector3d& v) {
        if (seen.empty()) first = v;
        from_it = combined(1.0, from_it, 1.0, difference(v, first));
        seen.push_back(i);
    }
    /// The mean.
    [[nodiscard]] Eigen::Vector3d viewpoint() const {
        return combined(1.0, first, 1.0 / static_cast<double>(seen.size()), from_it);
    }
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
    std::map<cube, sensor_place, std::less<>, pooled<std::pair<const cube, sensor_place>>> cubes;
    sensor_place* latest = nullptr;
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
        latest->add(static_cast<point_index>(i), v);
    }
    scratch<sensor_place> places;
    for (auto& [own, place] : cubes) places.push_back(std::move(place));
    return places;
}

}  // namespace gnomon::detail
