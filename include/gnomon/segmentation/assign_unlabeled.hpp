// SPDX-License-Identifier: BSL-1.0
/// @file
/// Assigns unlabeled points to adjacent planar segments: points near edges, where normals are
/// blended, and points so dense that their neighborhoods are hardly wider than the noise, so that
/// the segmentation by normals loses them.
///
/// A point may be within three standard deviations of a plane by chance, as points on the rim of a
/// thin board are. (Noise acts along the rays: at oblique incidence, its component across the
/// plane is smaller.) Therefore the mean of all unlabeled points in that slab about it is tested:
/// if they are on the plane, it is no farther from the plane than the noise of a mean. (Not in the
/// thesis, whose Alg. 4.2 leaves such points unlabeled; split_outliers is the reverse.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/scratch_graph.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/detail/unlabeled_assigner.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `assign_unlabeled`.
struct assign_unlabeled_options {
    double sigma = 0.015;        ///< standard deviation of ranges [m]
    std::size_t k = 20;          ///< a point is assigned to the segment of one of its k neighbors
    double max_distance = 0.30;  ///< and no farther from this neighbor [m]
};

namespace detail {

/// assign_unlabeled(index, parts, options, run), in the memory of `result`, which may be `parts`.
template <execution X>
void assign_unlabeled_into(segments& result, const spatial_index& points, const segments& parts,
                           const assign_unlabeled_options& options, const X& run) {
    require(parts.labels().size() == points.size(),
            "assign_unlabeled: the numbers of points and of labels differ");
    require(options.sigma > 0.0, "assign_unlabeled: sigma must be greater than 0");
    require(options.k > 0, "assign_unlabeled: k must be at least 1");
    require(options.max_distance >= 0.0,
            "assign_unlabeled: max_distance must not be negative or NaN");
    scratch<std::int32_t> labels(parts.labels().begin(), parts.labels().end());
    const scratch_graph graph = graph_of_some(
        options.k, [&](std::size_t i) { return labels[i] == unlabeled; }, points, run);
    const auto planes = planes_of_segments(points, parts, options.sigma, run);
    labels = unlabeled_assigner(points, graph, std::move(labels), planes, options.sigma,
                                options.max_distance)(run);
    number_by_size(labels);
    result.assign(labels);
}

}  // namespace detail

/// The segments with the unlabeled points that are on their planes. Segments that are thicker than
/// twice `sigma`, or narrower than it, do not grow. No point changes from one segment to another.
///
/// @param points  any point range of n points [m]; where view points are known, noise lies along
///                the rays, else it is the same in all directions
/// @param parts   segments of these points
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, segments or view points differ in number, or unless
///                                sigma is greater than 0, k at least 1 and max_distance not
///                                negative
/// Complexity: O(n (log n + k^2)) at worst, and a slab of cubes narrower than sigma for each pair
/// of a cube with unlabeled points and a segment adjacent to it.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments assign_unlabeled(const R& points, const segments& parts,
                                        const assign_unlabeled_options& options = {},
                                        const X& run = {}, Proj projection = {}) {
    const auto& team = detail::staying(run);
    segments result;
    detail::assign_unlabeled_into(result, detail::index_of(points, team, projection), parts,
                                  options, team);
    return result;
}

}  // namespace gnomon
