// SPDX-License-Identifier: BSL-1.0
/// @file
/// Planar segments. Smooth surfaces (segment_surfaces.hpp) end some points before an edge, where
/// normals are blended, and leak where the blend is gradual; membership in a plane is decided by
/// the distance from it, relative to the noise:
///
///  1. grow     From the flattest places on, points whose normals roughly agree join while they are
///              within three standard deviations of the region's plane, which is fit again as it
///              grows.
///  2. merge    Neighbors that one plane fits as well as two are one, unless they meet at an edge.
///  3. compete  Each point, whatever its normal, goes to the plane among its neighbors' that
///              explains it best, and planes are fit again: edges come out sharp.
///  4. cut      What two planes at an edge explain better is cut in two, merged and competed for.
///
/// These steps are repeated for the unlabeled points, by twice the angle, as edges blend normals.
/// Where the noise is independent from point to point, planes that meet at an angle of only 3
/// degrees are cut apart in the end, and planes with a step between them of more than 1 cm; and at
/// edges a point is rather of the plane that its ray ends on. It is taken to be so where view
/// points are known and the rays are not all within 45 degrees of one axis, as those of a depth
/// camera. At last, parts of a plane that no neighbors connect become segments of their own, if
/// they are large enough. All lengths follow from the noise and a flatness of 2 mm, so that no
/// distance need be set.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/ray_cone.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_growth.hpp>
#include <gnomon/segmentation/detail/plane_regions.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `segment_planes`.
struct segment_planes_options {
    noise_curve noise = constant_noise{};  ///< along the rays
    angle max_angle = degrees(15);         ///< rho_a, between a point's normal and its plane's
    std::size_t min_points = 30;           ///< n_min, smaller segments are noise
};

namespace detail {

/// @throws std::invalid_argument  for a max_angle outside [0, 90] degrees
inline void require_valid(const segment_planes_options& options) {
    (void)min_cosine(options.max_angle);
}

/// The regions of the planes of a cloud.
/// @param graph, near        those of `plane_regions`
/// @param noise_is_independent  from point to point; else it bends planes, as that of cameras
template <neighborhood_graph G, neighborhood_graph Near, normal_range S, execution X>
[[nodiscard]] plane_regions<G, Near> regions_of_planes(const planar_cloud& cloud, const G& graph,
                                                       const Near& nearby, const S& surface,
                                                       std::size_t min_points, angle max_angle,
                                                       bool noise_is_independent, const X& run) {
    plane_regions regions(cloud, graph, nearby, min_points);
    const double cosine = min_cosine(max_angle);
    regions.grow(surface, cosine, run);
    regions.cut_edges(run);
    regions.grow(surface, std::max(0.0, 2.0 * cosine * cosine - 1.0), run);  // of twice the angle
    regions.cut_edges(run);
    if (noise_is_independent) regions.cut_creases(run);
    regions.separate(run);
    return regions;
}

}  // namespace detail

/// The planes of a cloud; see `estimate_planes` for these themselves.
///
/// @param points   any point range of n points [m]; where view points are known, noise lies along
///                 the rays, else it is the same in all directions
/// @param graph    the neighbors of each: few, as edges are found to their width (`knn{20}`)
/// @param surface  a normal for each point; where it is missing, no plane grows, but a point may be
///                 taken by one
/// @return the segments of at least `min_points` points, largest first
/// @throws std::invalid_argument  if points, graph, surface or view points differ in number, the
///                                graph lists an index out of range, or max_angle is outside
///                                [0, 90] degrees
/// Complexity: O(n (log n + k)) for k neighbors in the graph, and O(t log t) for t pairs of regions
/// that touch. Growing runs on one thread. The same bytes for every execution.
template <class R, neighborhood_graph G, normal_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_planes(const R& points, const G& graph, const Surface& surface,
                                      const segment_planes_options& options = {}, const X& run = {},
                                      Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::require(std::ranges::size(surface) == index.size(),
                    "segment_planes: surface and points differ in size");
    detail::require_valid(options);
    detail::require_graph_of(index.size(), graph);
    const detail::planar_cloud cloud(index, options.noise, team);
    const bool is_independent = !index.viewpoints.empty() && !detail::is_of_camera(index);
    return detail::numbered_segments_of(
        detail::regions_of_planes(cloud, graph, graph, surface, options.min_points,
                                  options.max_angle, is_independent, team)
            .labels());
}

}  // namespace gnomon
