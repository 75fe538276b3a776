// SPDX-License-Identifier: BSL-1.0
/// @file
/// Alg. 4.3 to the letter, to reproduce and to compare with: one pass over the segments as they
/// are, narrow gaps closed whatever is seen in them, depths of lines interpolated from pixel to
/// pixel. Only the comparison of angles, which line 6 has the wrong way round, is set right
/// (specification of Klasing 2010, A15). Use merge_occluded.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/bresenham.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/segment_distances.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

namespace detail {

/// Whether a policy finds most pixels of a line in its favor: what is less far than the line is
/// closer, the rest farther.
template <merge_policy M>
[[nodiscard]] bool most_pixels_speak_for(const M& policy, const range_image& image,
                                         const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double first = image.distance_to(p), last = image.distance_to(q);
    std::size_t in_favor = 0, pixels = 0;
    for_each_pixel_between(image, image.pixel_of(p), image.pixel_of(q),
                           [&](const range_image::pixel& at, double share) {
                               const double range = image.range(at);
                               const bool closer = range < first + share * (last - first);
                               const sighting seen = range < 0.0 ? sighting::unseen
                                                     : closer    ? sighting::closer
                                                                 : sighting::farther;
                               in_favor += policy(seen) ? 1 : 0;
                               ++pixels;
                           });
    return 2 * in_favor > pixels;
}

}  // namespace detail

/// Merges flat segments as Alg. 4.3 says. Parameters as of merge_occluded, of whose options sigma
/// is not asked for; a pair of boundary points from different view points counts as not occluded.
/// @throws std::invalid_argument  if the segments are of another number of points, and for
///                                thresholds as in merge_occluded
template <class R, merge_policy M = conservative, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments merge_occluded_literally(const R& points, const segments& parts,
                                                const lines_of_sight& sights, const M& policy = {},
                                                const occlusion_merging& options = {},
                                                Proj projection = {}) {
    const position_view<R, Proj> p(points, projection);
    detail::require(parts.labels().size() == p.size(),
                    "merge_occluded_literally: the segments are of other points");
    detail::require_thresholds(options);
    const viewpoint_table viewpoints = viewpoints_of(points);
    // Near view points share an image, which is the nearest one.
    const auto image_of = [&](point_index i) {
        const auto distance = [&](const range_image& image) {
            return squared_distance(image.viewpoint(), viewpoints[i]);
        };
        return std::min_element(
            sights.images().begin(), sights.images().end(),
            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    };
    const auto is_occluded = [&](const boundary_pair& line) {
        const auto image = image_of(line.first);
        return image != sights.images().end() && is_finite(viewpoints[line.first]) &&
               is_finite(viewpoints[line.second]) && image == image_of(line.second) &&
               detail::most_pixels_speak_for(policy, *image, p[line.first], p[line.second]);
    };

    std::vector<principal_frame> frames;
    for (std::size_t s = 0; s < parts.size(); ++s)
        frames.push_back(principal_frame_of(subset_view<R, Proj>(points, parts[s], projection)));
    union_find sets(parts.size());
    for (const auto& [i, j] :
         detail::pairs_to_compare(frames, options.candidates, [&](const principal_frame& f) {
             return f.spectrum.lambda[0] > 0.0 &&  // else it is of nothing, or of one place
                    f.spectrum.surface_variation() <= options.max_variation;
         })) {
        if (angular_distance(frames[i], frames[j]) > options.max_angle.radians() ||
            orthogonal_distance(frames[i], frames[j]) >= options.max_offset)
            continue;
        const auto lines =
            boundary_pairs(p, parts[i], parts[j], {frames[i].centroid, frames[j].centroid},
                           options.boundary_pairs);
        const auto occluded = std::count_if(lines.begin(), lines.end(), is_occluded);
        if (coplanar_distance(lines) < options.max_gap ||
            2 * static_cast<std::size_t>(occluded) > lines.size())
            sets.unite(i, j);
    }
    std::vector<std::vector<point_index>> groups(parts.size());
    for (std::size_t s = 0; s < parts.size(); ++s) {
        auto& group = groups[sets.find(static_cast<point_index>(s))];
        group.insert(group.end(), parts[s].begin(), parts[s].end());
    }
    return detail::segments_of_groups(p.size(), groups);
}

}  // namespace gnomon
