// SPDX-License-Identifier: BSL-1.0
/// @file
/// A cloud thinned to its noise: the points of each cube, at most one standard deviation wide,
/// become their mean.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/hash_of.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::detail {

/// The cells of the finite points of an index, in the order of their first points.
struct cells {
    scratch<Eigen::Vector3d> means;  ///< [m]
    viewpoint_table viewpoints;      ///< the means of those of the points
    scratch<point_index> first;      ///< the first point of each
    scratch<point_index> counts;     ///< of the points of each
    scratch<point_index> of_point;   ///< the cell of each finite point; else no_cell

    /// @param width  width(i): of the cell of point i [m], greater than 0; rounded down to a power
    ///               of the root of 2, so that cells of many widths share a grid
    cells(const spatial_index& index, auto&& width) {
        const Eigen::Vector3d least = least_corner(index);
        of_point.assign(index.size(), no_cell);
        constexpr std::size_t fewest_slots = 16;  // performance only
        const std::size_t slots = std::bit_ceil(std::max(2 * index.finite(), fewest_slots));
        scratch<point_index> slot(slots, no_cell);
        scratch<key> keys;
        scratch<Eigen::Vector3d> seen_from;
        const bool has_many = index.viewpoints.positions().size() > 1;
        for (std::size_t i = 0; i < index.size(); ++i) {
            if (!index.is_finite(i)) continue;
            const Eigen::Vector3d p = index[i];
            const key own = key_of(difference(p, least), width(i));
            std::size_t at = static_cast<std::size_t>(hash_of(own)) & (slots - 1);
            while (slot[at] != no_cell && keys[slot[at]] != own) at = (at + 1) & (slots - 1);
            if (slot[at] == no_cell) {
                slot[at] = static_cast<point_index>(keys.size());
                keys.push_back(own);
                means.push_back(p);
                counts.push_back(0);
                first.push_back(static_cast<point_index>(i));
                if (has_many) seen_from.push_back(index.viewpoints[i]);
            }
            const point_index c = of_point[i] = slot[at];
            const double share = 1.0 / static_cast<double>(++counts[c]);
            means[c] = combined(1.0 - share, means[c], share, p);
            if (has_many)
                seen_from[c] = combined(1.0 - share, seen_from[c], share, index.viewpoints[i]);
        }
        if (has_many)
            viewpoints =
                viewpoint_table(std::vector<Eigen::Vector3d>(seen_from.begin(), seen_from.end()));
        else if (!index.viewpoints.empty())
            viewpoints = viewpoint_table(index.viewpoints.positions().front());
    }

    static constexpr point_index no_cell = std::numeric_limits<point_index>::max();

  private:
    using key = std::array<std::int64_t, 4>;

    [[nodiscard]] static Eigen::Vector3d least_corner(const spatial_index& index) {
        constexpr double infinity = std::numeric_limits<double>::infinity();
        Eigen::Vector3d least(infinity, infinity, infinity);
        for (std::size_t i = 0; i < index.size(); ++i) {
            if (!index.is_finite(i)) continue;
            const Eigen::Vector3d p = index[i];
            for (int a = 0; a < 3; ++a) least[a] = std::min(least[a], p[a]);
        }
        return least;
    }

    [[nodiscard]] static key key_of(const Eigen::Vector3d& offset, double width) {
        const double level = std::floor(2.0 * std::log2(width));
        const double side = std::exp2(0.5 * level);
        constexpr double most = 4e18;  // numerical: overflow of std::int64_t
        const auto cube = [&](int a) {
            return static_cast<std::int64_t>(std::floor(std::min(offset[a] / side, most)));
        };
        return {static_cast<std::int64_t>(level), cube(0), cube(1), cube(2)};
    }
};

}  // namespace gnomon::detail
