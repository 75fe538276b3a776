// SPDX-License-Identifier: BSL-1.0
/// @file
/// Removes the points at silhouettes that wide beams return wrongly: next to an edge, where a part
/// of the beam still hits the surface, which makes the leg of a chair seem wider; and between two
/// surfaces, at a mean of their ranges (mixed pixels; skimmed points in Klasing 2010, Sec. 5.8.4).
/// What is left of each surface is about as wide as the surface truly is.
///
///     auto kept = gnomon::remove_silhouettes(scan, {.divergence = gnomon::radians(0.010)});
///     gnomon::scan seen = gnomon::subset(scan, kept);
///
/// Neighbors of a point are here the points whose rays are next to its own, at whatever range: no
/// raster is needed, only view points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/filters/detail/flagged.hpp>
#include <gnomon/filters/detail/raster_reach.hpp>
#include <gnomon/filters/detail/ray_sphere.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// What a silhouette is, and how much of a surface next to it is lost.
struct silhouette_options {
    angle divergence = radians(0.010);  ///< full angle of the beams; that of wide laser beams
    /// Neighboring rays whose ranges differ by more [m] have hit two surfaces.
    double max_jump = detail::ray_sphere::usual_jump;

    /// @throws std::invalid_argument  unless divergence is from 0 to 90 degrees and max_jump >= 0
    void require_valid() const {
        detail::require(divergence >= degrees(0.0) && divergence <= degrees(90.0),
                        "remove_silhouettes: the divergence must be from 0 to 90 degrees");
        detail::require(max_jump >= 0.0,
                        "remove_silhouettes: max_jump must not be negative or NaN");
    }
};

/// The indices of the points that are at no silhouette, ascending; see subset.
///
/// A point is at a silhouette if the surface ends at it: against nothing, or against a surface
/// whose range differs by more than max_jump. Points whose rays are nearer to such a ray than half
/// the divergence, less the distance to their nearest ray, are removed too: the ray at the
/// silhouette is itself part of the half beam. So any beam, even one of zero width, costs at least
/// one ray at each side of a leg: only use it for beams that are wider than rays are apart.
///
/// How far rays are apart is measured around each; where they are more than four times farther
/// apart than most, points are removed. So are those of surfaces at grazing incidence, where
/// neighboring ranges differ by more than max_jump. Points without a ray, not finite or at their
/// view point, are left out. If rays are not next to each other in two directions, as in a single
/// scan line, no silhouette is found, and all points with a ray are kept.
///
/// @param points      any point range of n points [m]; seen from the origin without view points.
///                    Scans from view points farther apart than 2 m do not count as neighbors;
///                    those from nearer ones mix: use one call per scan
/// @param options     divergence of the beams, and what a jump is
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return the indices of the points to keep, for `subset`
/// @throws std::invalid_argument  if an option is out of range
/// Complexity: O(n (log n + m log m)) for m rays within the wider spacing of rays or half a beam.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] std::vector<point_index> remove_silhouettes(const R& points,
                                                          const silhouette_options& options = {},
                                                          const X& run = {}, Proj projection = {}) {
    options.require_valid();
    const auto& team = detail::staying(run);
    const detail::ray_sphere rays(points, options.max_jump, team, projection);
    const std::size_t n = rays.size();
    const detail::raster_reach reach(rays, team);
    detail::scratch<std::uint8_t> is_end(n, 0), is_kept(n, 0);
    detail::for_each_chunk(team, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
            if (rays.has_ray(i) && reach.is_known())
                is_end[i] = rays.is_surrounded(i, reach.around(rays, i)) ? 0 : 1;
    });
    const double half_beam = 0.5 * options.divergence.radians();
    detail::for_each_chunk(team, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (!rays.has_ray(i) || is_end[i] != 0) continue;
            // The silhouette itself has lost a ray already.
            const double rest = reach.is_known() ? half_beam - rays.distance_of(i, 1) : 0.0;
            const auto at_end = [&](const neighbor& q) { return is_end[q.index] != 0; };
            is_kept[i] = rest > 0.0 && std::ranges::any_of(rays.within(i, rest), at_end) ? 0 : 1;
        }
    });
    return detail::flagged(is_kept);
}

}  // namespace gnomon
