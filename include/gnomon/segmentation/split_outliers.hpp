// SPDX-License-Identifier: BSL-1.0
/// @file
/// Splits points off flat segments that are not on their planes: normals of a large neighborhood
/// turn slowly around the rim of a seat or a table top, so that a segmentation by normals includes
/// the rim. (Not in the thesis; assign_unlabeled gives what was split off to its neighbors.)
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// The segments without the points that are farther than three standard deviations from the plane
/// of a flat one, which are unlabeled then. Segments that are not flat keep all.
///
/// @param points  any point range of n points [m]; where view points are known, noise lies along
///                the rays, else it is the same in all directions
/// @param parts   segments of these points
/// @param noise   of the sensor
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, segments or view points differ in number
/// Complexity: O(n), and an index if `points` is none.
template <class R, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments split_outliers(const R& points, const segments& parts,
                                      const noise_curve& noise, const X& run = {},
                                      Proj projection = {}) {
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    detail::require(parts.labels().size() == index.size(),
                    "split_outliers: the numbers of points and of labels differ");
    const detail::planar_cloud cloud(index, noise, team);
    const auto regions = detail::regions_of(cloud, parts, team);
    std::vector<std::int32_t> labels = parts.labels();
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (labels[i] == unlabeled || !cloud.is_finite(i)) continue;
        const auto& of = regions[static_cast<std::size_t>(labels[i])];
        if (detail::misfit_of(cloud, i, of) < 0.0) labels[i] = unlabeled;
    }
    return detail::numbered_segments_of(std::move(labels));
}

}  // namespace gnomon
