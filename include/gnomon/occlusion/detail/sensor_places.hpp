// SPDX-License-Identifier: BSL-1.0
/// @file
/// The places of a moving sensor: view points in a cube as wide as the standard deviation of the
/// ranges are one place.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <type_traits>

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
/// the first about the least of them.
/// O(n log v) for v cubes; points of a scan line follow one another, so that there is hardly
/// anything to sort or to look up.
/// @param points      a position_view
/// @param viewpoints  a viewpoint_table (generic for compile time only)
[[nodiscard]] scratch<sensor_place> places_of_sensor(const auto& points, const auto& viewpoints,
                                                     double sigma) {
    using position = std::remove_cvref_t<decltype(viewpoints[0])>;
    using cube = std::array<typename position::Scalar, position::SizeAtCompileTime>;
    constexpr double exact = 1e-6;  // [m]; numerical: below, each view point is one
    constexpr double infinity = std::numeric_limits<double>::infinity();
    position least(infinity, infinity, infinity);
    for (const position& v : viewpoints.positions())
        for (int a = 0; a < 3 && is_finite(v); ++a) least[a] = std::min(least[a], v[a]);
    const auto cube_of = [&](const position& v) {
        if (sigma < exact) return cube{v[0], v[1], v[2]};
        const auto cell = [&](int a) { return std::round((v[a] - least[a]) / sigma); };
        return cube{cell(0), cell(1), cell(2)};
    };
    scratch<cube> cubes;
    if (viewpoints.empty()) {
        least = position(0.0, 0.0, 0.0);
        cubes.push_back(cube_of(least));
    }
    for (const position& v : viewpoints.positions())
        if (is_finite(v) && (cubes.empty() || cubes.back() != cube_of(v)))
            cubes.push_back(cube_of(v));
    std::sort(cubes.begin(), cubes.end());
    cubes.erase(std::unique(cubes.begin(), cubes.end()), cubes.end());
    scratch<sensor_place> places(cubes.size());
    std::size_t latest = 0;
    cube before{infinity, infinity, infinity};
    for (std::size_t i = 0; i < points.size(); ++i) {
        const position v = viewpoints[i];
        if (!is_finite(points[i]) || !is_finite(v)) continue;
        if (const cube own{v[0], v[1], v[2]}; own != before) {
            latest = static_cast<std::size_t>(
                std::lower_bound(cubes.begin(), cubes.end(), cube_of(v)) - cubes.begin());
            before = own;
        }
        places[latest].add(static_cast<point_index>(i), v);
    }
    std::erase_if(places, [](const sensor_place& place) { return place.seen.empty(); });
    return places;
}

}  // namespace gnomon::detail
