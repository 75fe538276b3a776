// SPDX-License-Identifier: BSL-1.0
/// @file
/// Alg. 4.3 as printed, for reproduction and comparison: one pass over the segments, narrow gaps
/// closed whatever is observed in them, depths of lines interpolated from pixel to pixel. Only the
/// comparison of angles, which line 6 has reversed, is corrected (docs/thesis-notes.md, A15). Use
/// merge_occluded.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/range_image.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

namespace detail {

/// rho_a, between the planes [rad], from 0 to pi / 2, Eq. (4.5). Where Fig. 4.6 names the inner
/// product itself, the equation stands.
[[nodiscard]] inline double angular_distance(const principal_frame& a, const principal_frame& b) {
    const Eigen::Vector3d n = a.normal(), m = b.normal();
    // Unlike acos, exact for small angles.
    return std::atan2(length(cross(n, m)), std::abs(dot(n, m)));
}

/// rho_o, the smaller of the distances of each centroid from the other's plane [m], Eq. (4.6).
[[nodiscard]] inline double orthogonal_distance(const principal_frame& a,
                                                const principal_frame& b) {
    const Eigen::Vector3d between = difference(b.centroid, a.centroid);
    return std::min(std::abs(dot(a.normal(), between)), std::abs(dot(b.normal(), between)));
}

/// Calls visit(pixel, share) for the pixels of a straight line from one pixel to another, both
/// included, by the shorter way around: across the seam where azimuth pi meets -pi, if that is
/// nearer (Bresenham 1965; Klasing 2010, Sec. 4.3.2). share is how far along, from 0 to 1.
inline void for_each_pixel_between(const range_image& image, const range_image::pixel& from,
                                   const range_image::pixel& to, auto&& visit) {
    const auto column = static_cast<double>(from.azimuth),
               row = static_cast<double>(from.elevation);
    const auto width = static_cast<double>(image.width());
    const double across = std::remainder(static_cast<double>(to.azimuth) - column, width);
    const double up = static_cast<double>(to.elevation) - row;
    const double steps = std::max(std::abs(across), std::abs(up)), most = std::max(steps, 1.0);
    for (double s = 0.0; s <= steps; s += 1.0) {
        const double azimuth = column + std::round(across * s / most) + width;
        const double elevation = row + std::round(up * s / most);
        visit(range_image::pixel{static_cast<std::size_t>(azimuth) % image.width(),
                                 static_cast<std::size_t>(elevation)},
              s / most);
    }
}

/// Whether a policy finds most pixels of a line in its favor: a pixel shows something closer than
/// the line, or else farther.
template <merge_policy M>
[[nodiscard]] bool most_pixels_speak_for(const M& policy, const range_image& image,
                                         const Eigen::Vector3d& p, const Eigen::Vector3d& q) {
    const double first = image.distance_to(p), last = image.distance_to(q);
    std::size_t in_favor = 0, pixels = 0;
    for_each_pixel_between(image, image.pixel_of(p), image.pixel_of(q),
                           [&](const range_image::pixel& at, double share) {
                               const double range = image.range(at);
                               const bool closer = range < first + share * (last - first);
                               const observation seen = range < 0.0 ? observation::unobserved
                                                        : closer    ? observation::occluded
                                                                    : observation::free_space;
                               in_favor += policy(seen) ? 1 : 0;
                               ++pixels;
                           });
    return 2 * in_favor > pixels;
}

}  // namespace detail

/// Parameters of Alg. 4.3, with the thesis's values (Sec. 4.4.1).
struct literal_merging_options {
    double max_variation =
        0.15;  ///< sigma_sv,max of a flat segment, Eq. (3.28): 0 a plane, 1 a ball
    angle max_angle = degrees(15);   ///< rho_a between coplanar segments
    double max_offset = 0.05;        ///< rho_o of coplanar segments [m]
    double max_gap = 0.20;           ///< rho_c [m]: narrower gaps are closed
    std::size_t boundary_pairs = 6;  ///< n_b, an even number
    std::size_t candidates = merge_occluded_options{}.candidates;  ///< k_c
};

/// Merges flat segments by Alg. 4.3; a pair of boundary points from different view points counts as
/// not occluded.
///
/// @param points   any point range of n points [m]; their view points as in `visibility`
/// @param parts    segments of these points
/// @param visible  what was seen from where
/// @param policy   `conservative`, `liberal` or another
/// @return the segments afterwards, largest first
/// @throws std::invalid_argument  if the segments or view points are for another number of points,
///                                and for an odd or no number of boundary pairs, no candidate, and
///                                a negative or NaN threshold
/// Complexity: O(n + m log m) for m segments, or O(n + m^2) if all are compared; and for each of
/// the pairs, O(boundary_pairs * (their points + images + pixels of its lines)).
template <class R, merge_policy M = conservative, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments merge_occluded_literally(const R& points, const segments& parts,
                                                const visibility& visible, const M& policy = {},
                                                const literal_merging_options& options = {},
                                                Proj projection = {}) {
    const position_view<R, Proj> p(points, projection);
    detail::require(parts.labels().size() == p.size(),
                    "merge_occluded_literally: segments and points differ in number");
    detail::require_pairs(options);
    detail::require(options.max_variation >= 0.0 && options.max_offset >= 0.0 &&
                        options.max_gap >= 0.0 && options.max_angle.radians() >= 0.0,
                    "merge_occluded_literally: a threshold is negative or NaN");
    const viewpoint_table viewpoints = detail::viewpoints_of(points);
    // Near view points share an image, which is the nearest one.
    const auto image_of = [&](point_index i) {
        const auto distance = [&](const range_image& image) {
            return squared_distance(image.viewpoint(), viewpoints[i]);
        };
        return std::min_element(
            visible.images().begin(), visible.images().end(),
            [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
    };
    const auto is_occluded = [&](const detail::boundary_pair& line) {
        const auto image = image_of(line.first);
        return image != visible.images().end() && is_finite(viewpoints[line.first]) &&
               is_finite(viewpoints[line.second]) && image == image_of(line.second) &&
               detail::most_pixels_speak_for(policy, *image, p[line.first], p[line.second]);
    };

    std::vector<principal_frame> frames;
    for (std::size_t s = 0; s < parts.size(); ++s)
        frames.push_back(principal_frame::of(subset_view<R, Proj>(points, parts[s], projection)));
    detail::union_find sets(parts.size());
    const auto is_flat = [&](std::size_t s) {
        return frames[s].spectrum.lambda[0] > 0.0 &&  // else it is of nothing, or of one place
               frames[s].spectrum.surface_variation() <= options.max_variation;
    };
    const auto centroid_of = [&](std::size_t s) { return frames[s].centroid; };
    for (const auto& [i, j] :
         detail::pairs_to_compare(frames.size(), options.candidates, is_flat, centroid_of)) {
        if (detail::angular_distance(frames[i], frames[j]) > options.max_angle.radians() ||
            detail::orthogonal_distance(frames[i], frames[j]) >= options.max_offset)
            continue;
        std::vector<detail::boundary_pair> lines;
        detail::append_boundary_pairs(lines, p, parts[i], parts[j],
                                      {frames[i].centroid, frames[j].centroid},
                                      options.boundary_pairs);
        const auto occluded = std::count_if(lines.begin(), lines.end(), is_occluded);
        if (detail::coplanar_distance(lines) < options.max_gap ||
            2 * static_cast<std::size_t>(occluded) > lines.size())
            sets.unite(i, j);
    }
    return detail::united_segments(parts, sets);
}

}  // namespace gnomon
