// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planar segments with their planes. Smooth surfaces (segment_surfaces.hpp) end some points before
/// an edge, where normals are blended, and leak where the blend is gradual; membership in a plane
/// is decided by the distance from it, relative to the noise:
///
///  1. grow     From the flattest places on, points whose normals roughly agree join while they lie
///              within a few deviations of the region's plane, which is fitted again as it grows.
///  2. merge    Neighbors that one plane fits as well as two are one.
///  3. compete  Each point, whatever its normal, goes to the plane among its neighbors' that
///              explains it best, and planes are fitted again: edges come out sharp.
///
/// Region growing after Poppinga et al. 2008, merging after agglomerative clustering (Feng et al.
/// 2014), and the competition for points after variational shape approximation (Cohen-Steiner et
/// al. 2004) with the Potts model of Isack and Boykov 2012. All lengths are multiples of the noise,
/// so that no distance need be set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <optional>
#include <utility>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/noise_level.hpp>
#include <gnomon/segmentation/detail/plane_growth.hpp>
#include <gnomon/segmentation/detail/plane_regions.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `segment_planes`.
struct segment_planes_options {
    std::optional<double> noise =
        {};                         ///< sigma across the surface [m]; else what `noise_level` finds
    double max_deviations = 4.0;    ///< of a point from its plane, in sigma
    angle max_angle = degrees(25);  ///< between a point's normal and its plane's, to grow
    std::size_t min_points = 30;    ///< n_min, smaller segments are noise
    int rounds = 6;                 ///< of the competition, at most
};

/// Segments, and the plane of each.
struct planar_segments {
    gnomon::segments segments;  ///< largest first
    std::vector<plane> planes;  ///< by label; the normal's sign is arbitrary
};

/// The planes of a cloud.
///
/// @param points   any point range of n points [m]
/// @param graph    the neighbors of each: few, as edges are found to their width (`knn{12}`)
/// @param surface  a normal for each point, from as few; where it is missing, no plane grows, but a
///                 point may be taken by one
/// @return the segments of at least `min_points` points and their planes
/// @throws std::invalid_argument  if points, graph and surface differ in size or the graph lists an
///                                index out of range; unless noise and max_deviations are finite
///                                and not negative, and max_angle is from 0 to 90 degrees
/// Complexity: O(n (log n + k)) for k neighbors in the graph where what grows is kept, and O(n m k)
/// where it stays below m = min_points; O(t log t) for t pairs of regions that touch, and O(t^2
/// log t) at worst. Growing runs on one thread. The same bytes for every execution.
template <class R, neighborhood_graph G, normal_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] planar_segments segment_planes(const R& points, const G& graph,
                                             const Surface& surface,
                                             const segment_planes_options& options = {},
                                             const X& run = {}, Proj projection = {}) {
    const auto is_length = [](double x) { return x >= 0.0 && std::isfinite(x); };
    const position_view<R, Proj> p(points, projection);
    detail::require(graph.size() == p.size(), "segment_planes: graph and points differ in size");
    detail::require(std::ranges::size(surface) == p.size(),
                    "segment_planes: surface and points differ in size");
    detail::require(!options.noise || is_length(*options.noise),
                    "segment_planes: the noise must be finite and not negative");
    detail::require(is_length(options.max_deviations),
                    "segment_planes: max_deviations must be finite and not negative");
    double farthest = 0.0;
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (const point_index j : graph[i])
            detail::require(j < p.size(), "segment_planes: the graph has an index out of range");
        if (is_finite(p[i])) farthest = std::max(farthest, p[i].cwiseAbs().maxCoeff());
    }
    // Of a clean cloud, rounding is the noise.
    const double rounding = 1e-12 * farthest;
    const double noise = options.noise ? *options.noise : noise_level(points, run, projection);

    const detail::plane_rules rules{.noise = std::max(noise, rounding),
                                    .deviations = options.max_deviations,
                                    .min_cosine = detail::min_cosine(options.max_angle),
                                    .min_points = std::max<std::size_t>(options.min_points, 3)};
    detail::plane_growth grow(p, graph, surface, rules);
    detail::plane_regions regions(p, graph, rules, grow(run));
    regions.merge();
    for (int round = 0; round < options.rounds; ++round) {
        if (!regions.compete(run)) break;
        regions.merge();
    }

    std::vector<std::int32_t> labels = regions.labels();
    const auto label_of = detail::number_by_size(labels);
    planar_segments result{segments(std::move(labels)), {}};
    for (const std::int32_t label : label_of)
        result.planes.push_back(regions.plane_of(static_cast<std::size_t>(label)));
    return result;
}

}  // namespace gnomon
