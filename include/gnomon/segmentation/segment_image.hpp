// SPDX-License-Identifier: BSL-1.0
/// @file
/// Smooth surfaces of an organized image, on the pixels that a `raster` links. In no umbrella, as
/// few have images: include it by name.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/image_links.hpp>
#include <gnomon/neighborhoods/raster.hpp>
#include <gnomon/segmentation/detail/image_surfaces.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// The smooth surfaces of an organized image: pixels that are next to each other, and have no jump
/// in range between them, are linked where their normals agree. Edges belong to one of the surfaces
/// that meet there if its plane explains them (detail/image_surfaces.hpp).
///
/// @param points   the n points of the image, row by row
/// @param pixels   its width, and the noise along the rays from the view points or the origin
/// @param surface  their n surface elements, as estimate_normals(points, pixels) returns them; of
///                 estimates without `spectrum`, flat edges may be lost
/// @param options  `min_points` counts pixels away from edges; segments that one plane explains
///                 within the noise are merged whatever `max_angle` and `oriented` are
/// @param run      `sequential{}` or `threads{n}`
/// @return the segments, largest first; pixels without a return are unlabeled
/// @throws std::invalid_argument  if points and surface differ in size, for options out of range,
///                                and where `raster` throws
/// Complexity: O(n r + m log m) for windows of radius r and m pairs of adjacent segments. The same
/// bytes for every execution.
template <class R, surfel_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_surfaces(const R& points, const raster& pixels,
                                        const Surface& surface,
                                        const segment_surfaces_options& options = {},
                                        const X& run = {}, Proj projection = {}) {
    const auto& team = detail::staying(run);
    const position_view<R, Proj> p(points, std::move(projection));
    const detail::pixel_rectangle image = pixels.image_of(points);
    const detail::smooth_link<Surface> link(surface, options, p.size());
    segment_surfaces_options of_twice_the_angle = options;
    constexpr angle right = degrees(90);  // formula: no angle between two lines is larger
    of_twice_the_angle.max_angle = std::min(radians(2.0 * options.max_angle.radians()), right);
    const detail::smooth_link<Surface> wide_link(surface, of_twice_the_angle, p.size());
    return detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
        const detail::image_links links(p, viewpoints, pixels.noise, image, pixels.largest_radius(),
                                        team);
        detail::image_surfaces found(links, surface,
                                     detail::epsilon_of<position_view<R, Proj>>(points),
                                     options.max_distance);
        return detail::segments_of(found.labels(link, wide_link, options.min_points, team));
    });
}

}  // namespace gnomon
