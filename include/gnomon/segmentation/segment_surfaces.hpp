// SPDX-License-Identifier: BSL-1.0
/// @file
/// Smooth surfaces: neighboring points are one surface where their normals turn by at most a small
/// angle. The search radius follows the density of the scan, so that the sparse rim of a rotational
/// scan is treated like its dense middle.
///
/// Klasing 2010, Sec. 4.2.5, Eq. (4.3) and Alg. 4.2, with the parameters of Sec. 4.4.1.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/link_within.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Normals with the mean distance to the neighbors, as estimate_normals gives them.
template <class S>
concept surfel_range = normal_range<S> && requires(const S& surface, std::size_t i) {
    { surface[i].mean_distance } -> std::convertible_to<double>;
};

/// Parameters of Alg. 4.2, with the thesis's values.
struct segment_surfaces_options {
    angle max_angle = degrees(5);  ///< alpha_max between normals of neighbors
    double max_distance = 0.30;    ///< rho_max [m], no link is longer; may be infinite
    std::size_t min_points = 30;   ///< n_min, smaller segments are noise
    /// Compare oriented normals, so that the two sides of a thin board, seen from two view points,
    /// stay apart; the thesis compares |<n_i, n_j>|.
    bool oriented = false;
};

namespace detail {

/// @throws std::invalid_argument  for a negative or NaN max_distance or a max_angle outside [0, 90]
///                                degrees
inline void require_valid(const segment_surfaces_options& options) {
    (void)min_cosine(options.max_angle);
    require(options.max_distance >= 0.0,
            "segment_surfaces: max_distance must not be negative or NaN");
}

/// The criterion and the search radius of Alg. 4.2.
template <surfel_range Surface>
class smooth_link {
  public:
    smooth_link(const Surface& surface, const segment_surfaces_options& options, std::size_t points)
        : surface_(surface), options_(options), min_cosine_(min_cosine(options.max_angle)) {
        require(std::ranges::size(surface) == points,
                "segment_surfaces: surface and points differ in size");
        require_valid(options);
    }

    /// rho_s of point i [m], Eq. (4.3); none for a missing normal. The margin lets a neighbor in
    /// that is as far as the mean says but for rounding, as on regular grids, so that turning the
    /// cloud changes nothing.
    [[nodiscard]] double radius(std::size_t i) const {
        if (is_missing(surface_[i].normal)) return no_search;
        constexpr double margin = 1.0 + 1e-9;  // rounding
        return std::min(margin * static_cast<double>(surface_[i].mean_distance),
                        options_.max_distance);
    }

    /// Whether the normal of the neighbor is there and agrees with that of i.
    [[nodiscard]] bool operator()(std::size_t i, const neighbor& q) const {
        const Eigen::Vector3d& n_j = surface_[q.index].normal;
        if (is_missing(n_j)) return false;
        const double cosine = surface_[i].normal.dot(n_j);
        return (options_.oriented ? cosine : std::abs(cosine)) >= min_cosine_;
    }

  private:
    const Surface& surface_;
    segment_surfaces_options options_;
    double min_cosine_;
};

/// segment_surfaces(index, surface, options, run), in the memory of `result`.
template <surfel_range Surface, execution X>
void segment_surfaces_into(segments& result, const spatial_index& index, const Surface& surface,
                           const segment_surfaces_options& options, const X& run) {
    const smooth_link<Surface> link(surface, options, index.size());
    linker linker(index);
    linker.link_all([&link](std::size_t i) { return link.radius(i); }, link, run);
    result.assign(linker.labels(options.min_points));
}

}  // namespace detail

/// The smooth surfaces of a cloud, exact: every point within the radius is looked at.
///
/// @param points   any point range of n points
/// @param surface  their n surface elements; where the normal is zero, nothing is joined
/// @return the segments of at least `min_points` points, largest first
/// @throws std::invalid_argument  if surface and points differ in size, for a negative or NaN
///                                max_distance or a max_angle outside [0, 90] degrees
/// Complexity: O(n (log n + k_r)) for k_r points within the radius. The same bytes for every
/// execution.
template <class R, surfel_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_surfaces(const R& points, const Surface& surface,
                                        const segment_surfaces_options& options = {},
                                        const X& run = {}, Proj projection = {}) {
    const auto& team = detail::staying(run);
    segments result;
    detail::segment_surfaces_into(result, detail::index_of(points, team, projection), surface,
                                  options, team);
    return result;
}

/// The same over a stored graph: no second search, and of the points within the radius only those
/// that the graph lists (k_r <= k in Alg. 4.2). For the graph that the surface was estimated from
/// it differs from the exact one only at points repaired from a wider neighborhood, and where more
/// neighbors tie than the graph lists.
/// @throws std::invalid_argument  also if graph and points differ in size, or the graph lists an
///                                index out of range
/// Complexity: O(n k) for k neighbors in the graph. The same bytes for every execution.
template <class R, neighborhood_graph G, surfel_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments segment_surfaces(const R& points, const G& graph, const Surface& surface,
                                        const segment_surfaces_options& options = {},
                                        const X& run = {}, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require_graph_of(p.size(), graph);
    const detail::smooth_link<Surface> link(surface, options, p.size());
    detail::linker linker(p);
    linker.link_listed(
        graph, [&link](std::size_t i) { return link.radius(i); }, link, run);
    return detail::segments_of(linker.labels(options.min_points));
}

}  // namespace gnomon
