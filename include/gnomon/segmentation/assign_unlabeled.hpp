// SPDX-License-Identifier: BSL-1.0
/// @file
/// Assigns points to the segments next to them by competition: each point goes to that segment,
/// among its own and those of its neighbors, whose plane explains it best. Points near edges, which
/// a segmentation by normals leaves out or gives to the wrong side, come to the right one. (Not in
/// the thesis. After variational shape approximation, Cohen-Steiner et al. 2004, with the Potts
/// model of Isack and Boykov 2012.)
#pragma once

#include <algorithm>
#include <functional>
#include <utility>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// The segments after the competition for points. A flat segment gets the points within three
/// standard deviations of its plane, and loses those beyond to neighbors, or to none; for others a
/// point counts as if it were one deviation away.
///
/// @param points  any point range of n points [m]; where view points are known, noise lies along
///                the rays, else it is the same in all directions
/// @param graph   the neighbors of each, as `knn{20}` finds them
/// @param parts   segments of these points
/// @param noise   of the sensor
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, graph, segments or view points differ in number, or
///                                the graph lists an index out of range
/// Complexity: O(n k) for k neighbors in the graph, and an index if `points` is none.
template <class R, neighborhood_graph G, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments assign_unlabeled(const R& points, const G& graph, const segments& parts,
                                        const noise_curve& noise, const X& run = {},
                                        Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::require(parts.labels().size() == index.size(),
                    "assign_unlabeled: the numbers of points and of labels differ");
    detail::require_graph_of(index.size(), graph);
    const detail::planar_cloud cloud(index, noise, team);
    segments result = parts;
    auto is_border = detail::borders_of(graph, parts.labels(), team);
    for (int round = 0; round < detail::most_rounds; ++round) {
        const auto regions = detail::regions_of(cloud, result, team);
        const auto labels = detail::compete(cloud, graph, regions, detail::region_edges<>(),
                                            result.labels(), is_border, team);
        if (std::equal(labels.begin(), labels.end(), result.labels().begin())) break;
        result.assign(labels);
    }
    return detail::numbered_segments_of(std::move(result).labels());
}

}  // namespace gnomon
