// SPDX-License-Identifier: BSL-1.0
/// @file
/// Crops a cloud to the heights between floor and ceiling, which `find_floor` and `find_ceiling`
/// find. Klasing 2010, Sec. 4.2.2.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// Which heights above the floor to leave out.
struct crop_height_options {
    double floor = 0.05;    ///< up to this height [m]; rho_o
    double ceiling = 0.05;  ///< down to this far below the ceiling [m]; rho_o
};

namespace detail {

inline void require_valid(const crop_height_options& bands) {
    require(!std::isnan(bands.floor) && !std::isnan(bands.ceiling),
            "crop_height: the bands must not be NaN");
}

/// crop_height(), over a position_view and in the memory of `kept`.
void crop_height_into(std::vector<point_index>& kept, const auto& p, const plane& floor,
                      std::optional<double> ceiling, const crop_height_options& bands) {
    require_hesse(floor);
    require_valid(bands);
    require(!ceiling || !std::isnan(*ceiling), "crop_height: the ceiling must not be NaN");
    kept.clear();
    for (std::size_t i = 0; i < p.size(); ++i) {
        if (!is_finite(p[i])) continue;
        const double height = floor.signed_distance(p[i]);
        if (height > bands.floor && !(ceiling && height >= *ceiling - bands.ceiling))
            kept.push_back(static_cast<point_index>(i));
    }
}

}  // namespace detail

/// The indices of the points between the bands of floor and ceiling, ascending; see subset_view.
/// Points that are not finite are left out.
///
/// @param ceiling  its height above the floor [m], or nothing to keep all that is above the floor
/// @throws std::invalid_argument  unless the floor's normal is of unit length, or if a height is
///                                NaN
/// Complexity: O(n).
template <class R, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> crop_height(const R& points, const plane& floor,
                                                   std::optional<double> ceiling,
                                                   const crop_height_options& bands = {},
                                                   Proj projection = {}) {
    std::vector<point_index> kept;
    detail::crop_height_into(kept, position_view<R, Proj>(points, std::move(projection)), floor,
                             ceiling, bands);
    return kept;
}

}  // namespace gnomon
