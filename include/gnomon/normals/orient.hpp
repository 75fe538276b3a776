// SPDX-License-Identifier: BSL-1.0
/// @file
/// Consistent orientation of normals towards the sensor: a sensor sees surfaces from outside.
///
/// Klasing 2010, Sec. 3.2.10, Eq. (3.20).
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <utility>

#include <gnomon/core/detail/refused_points.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

/// Negates each normal that does not face the view point of its point: <n, p - v> <= 0 afterwards.
///
/// @param points      n points [m] with view points: a scan, or with_viewpoint(s)(points, ...); the
///                    view point of a plain range is the origin
/// @param surface     n normals; changed in place. Missing normals (zero) stay.
/// @param projection  makes a point of an element of the range
/// @throws std::invalid_argument  if surface, view points and points differ in number, or a normal
///                                has a view point that is not finite
/// Complexity: O(n).
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj> && (!std::is_const_v<Surface>)
void orient_normals(const R& points, Surface& surface, const X& run = {}, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(std::ranges::size(surface) == p.size(),
                    "orient_normals: surface and points differ in size");
    detail::with_table_of(points, [&](const viewpoint_table& v) {
        detail::for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                auto& n = surface[i].normal;
                if (is_missing(n)) continue;
                detail::require(is_finite(v[i]), "orient_normals: a view point is not finite");
                if (n.dot(p[i] - v[i]) > 0.0) n = -n;
            }
        });
    });
}

/// Refused: the arguments are in the wrong order.
template <normal_range Surface, point_range R>
    requires(!point_range<Surface>)
void orient_normals(const Surface&, const R&) {
    static_assert(detail::never<R>,
                  "the points come before the surface: orient_normals(points, surface)");
}

}  // namespace gnomon
