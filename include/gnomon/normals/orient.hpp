// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals that face the sensor: what was seen was seen from its outer side.
///
/// Klasing 2010, Sec. 3.2.10, Eq. (3.20).
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

/// Turns each normal towards the view point of its point: <n, p - v> <= 0 afterwards.
///
/// @param points   a scan, or with_viewpoint(s)(points, ...); a bare range was seen from the origin
/// @param surface  a normal for each point; changed in place
/// @throws std::invalid_argument  if surface, view points and points differ in number, or a normal
///                                has a view point that is not finite
/// Complexity: O(n).
template <class R, normal_range Surface, class Proj = std::identity>
    requires point_range<R, Proj> && (!std::is_const_v<Surface>)
void orient_normals(const R& points, Surface& surface, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    const viewpoint_table v = viewpoints_of(points);
    detail::require(std::ranges::size(surface) == p.size(),
                    "orient_normals: the surface is of other points");
    for (std::size_t i = 0; i < p.size(); ++i) {
        auto& n = surface[i].normal;
        if (is_missing(n)) continue;
        detail::require(is_finite(v[i]), "orient_normals: a view point is not finite");
        if (n.dot(p[i] - v[i]) > 0.0) n = -n;
    }
}

}  // namespace gnomon
