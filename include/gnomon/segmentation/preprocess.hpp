// SPDX-License-Identifier: BSL-1.0
/// @file
/// Finds floor and ceiling, for `crop_height` to remove both: they are often more than half of an
/// indoor scan and connect all objects on them. Klasing 2010, Sec. 4.2.2, which leaves the widths
/// of the bands open; the floor is refitted to its band until it converges, so that tilts are
/// found. A level plane that is no floor, such as a table top, is not taken for one.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/segmentation/detail/floor_search.hpp>
#include <gnomon/segmentation/detail/height_histogram.hpp>

namespace gnomon {

/// What counts as the floor.
struct find_floor_options {
    double band = 0.1;       ///< half the height of the band about a first guess [m]; chosen
    double min_width = 1.4;  ///< in both directions [m]; chosen: table tops are up to 1.2 m wide
};

/// Where to look for the ceiling, in heights above the floor.
struct find_ceiling_options {
    double min_height = 1.8;  ///< [m]; chosen
    double bin = 0.02;        ///< of the histogram of heights [m]; chosen
    double min_share = 0.01;  ///< of all points that the ceiling's bin must hold to be one; chosen
};

namespace detail {

inline void require_valid(const find_floor_options& search) {
    require(search.band > 0.0 && search.min_width > 0.0,
            "find_floor: band and width must be positive");
}

inline void require_valid(const find_ceiling_options& search) {
    constexpr double finest = 1e-6, widest = 1e6;  // [m]; numerical: heights have a bin each
    require(search.bin >= finest && search.bin <= widest,
            "find_ceiling: the bin must be from 1e-6 m to 1e6 m wide");
    require(search.min_share >= 0.0, "find_ceiling: min_share must not be negative or NaN");
    require(!std::isnan(search.min_height), "find_ceiling: min_height must not be NaN");
}

}  // namespace detail

/// The floor: the lowest plane that is level, has hardly a point below it and the sensor, where
/// its view points are known, above it, and is clear of other things over a width that furniture
/// does not have. It is fitted where nothing stands on it.
///
/// @param up  unit vector against gravity; the floor is tilted by less than atan(2 band / width), 8
///            degrees by default (tested up to 3 degrees, docs/results/surfaces.md)
/// @return the plane, its normal on the side of `up`; nothing if no plane is a floor
/// @throws std::invalid_argument  unless band and width are positive and `up` is of unit length,
///                                or if the view points are for another number of points
/// Complexity: O(n log n), and for each height at which many points lie, O(n) per refit, a handful
/// of them, at most 50. Most scans of a floor have one such height to examine.
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::optional<plane> find_floor(const R& points,
                                              const Eigen::Vector3d& up = {0.0, 0.0, 1.0},
                                              const find_floor_options& search = {},
                                              Proj projection = {}) {
    detail::require_valid(search);
    detail::require_hesse({up, 0.0});
    const position_view<R, Proj> p(points, std::move(projection));
    const detail::height_histogram heights(p, plane{up, 0.0}, search.band);
    return detail::with_table_of(points, [&](const viewpoint_table& seen_from) {
        detail::floor_search floors(p, seen_from, search.band, search.min_width);
        return floors.lowest(up, heights);
    });
}

/// The height of the ceiling above the floor [m]: the most frequent one above `min_height`.
///
/// @return nothing if no height holds `min_share` of the points (an open sky, a low view)
/// @throws std::invalid_argument  unless the bin is from 1e-6 m to 1e6 m wide, the share is not
///                                negative, and the floor's normal of unit length; if an option is
///                                NaN
/// Complexity: O(n log n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::optional<double> find_ceiling(const R& points, const plane& floor,
                                                 const find_ceiling_options& search = {},
                                                 Proj projection = {}) {
    detail::require_valid(search);
    detail::require_hesse(floor);
    const position_view<R, Proj> p(points, std::move(projection));
    const detail::height_histogram heights(p, floor, search.bin, search.min_height);
    if (heights.bins.empty()) return std::nullopt;
    const auto [peak, count] = detail::fullest(heights);
    if (static_cast<double>(count) < search.min_share * static_cast<double>(heights.points))
        return std::nullopt;
    // The mean over the peak and its neighbors is finer than the bin and free of its phase.
    constexpr double half_width = 1.5;  // bins: half of three (formula)
    double sum = 0.0, nearby = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        const double height = floor.signed_distance(p[i]);
        if (!(height >= search.min_height && std::abs(height - peak) <= half_width * search.bin))
            continue;
        sum += height;
        nearby += 1.0;
    }
    return nearby > 0.0 ? sum / nearby : peak;  // no point is near if bins are finer than rounding
}

}  // namespace gnomon
