// SPDX-License-Identifier: BSL-1.0
/// @file
/// Frees the points of flat segments that are not of their planes: normals of a large neighborhood
/// turn slowly round the rim of a seat or a table top, so that a segmentation by normals takes the
/// rim in, and of a surface that few scan lines meet, the rim may be a third.
///
/// A rim may be as narrow as noise is wide. But noise lies along the rays, so that little of it is
/// across a surface seen at a slant; and the mean of a point and those about it tells more than the
/// point. Floors that are warped, or measured in steps, are off their planes too: their normals are
/// not. (Not in the thesis; claim_strays is the reverse.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/detail/knn_of_some.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `release_strays`.
struct stray_releasing {
    double sigma = 0.015;            ///< standard deviation of ranges [m]
    std::size_t k = 8;               ///< points are judged, and hang together, with so many nearest
    double max_distance = 0.30;      ///< that are no farther [m]
    angle max_angle = degrees(7.5);  ///< off the plane's: points with such a normal stay
    std::size_t min_points = 30;     ///< so many released ones together are a segment
};

namespace detail {

/// Whether point i of a segment is on its plane: the mean of it and its neighbors may be off by
/// four standard deviations of a mean, as so many are looked at, and it by five of its own.
/// Neighbors that are farther off count as if by five, so that no single one decides; those of
/// another segment say nothing. What is not finite is off no plane.
[[nodiscard]] bool is_on(const auto& points, const viewpoint_table& viewpoints,
                         const adjacency& graph, const segments& parts, std::size_t i,
                         const noisy_plane& of, double max_distance) {
    constexpr double mean_at_most = 4.0, each_at_most = 5.0;
    if (!is_finite(points[i])) return true;
    const auto deviations_off = [&](std::size_t j) {
        const Eigen::Vector3d q = points[j];
        return of.distance(q) / of.deviation_at(q, known_viewpoint(viewpoints, j));
    };
    double sum = deviations_off(i), count = 1.0;
    if (std::abs(sum) > each_at_most) return false;
    for (const point_index j : graph[i]) {
        if (squared_distance(points[j], points[i]) > max_distance * max_distance) break;
        if (parts.labels()[j] != unlabeled && parts.labels()[j] != parts.labels()[i]) continue;
        sum += std::clamp(deviations_off(j), -each_at_most, each_at_most);
        count += 1.0;
    }
    return std::abs(sum) <= mean_at_most * std::sqrt(count);
}

/// The labels, where points that had the same label and have none now, and hang together as
/// neighbors, are segments of their own.
[[nodiscard]] std::vector<std::int32_t> with_released_groups(const auto& points,
                                                             const adjacency& graph,
                                                             const segments& before,
                                                             std::vector<std::int32_t> labels,
                                                             const stray_releasing& options) {
    const auto is_released = [&](std::size_t i) { return labels[i] != before.labels()[i]; };
    union_find sets(labels.size());
    for (std::size_t i = 0; i < labels.size(); ++i) {
        if (!is_released(i)) continue;
        for (const point_index j : graph[i]) {
            const double squared = squared_distance(points[j], points[i]);
            if (squared > options.max_distance * options.max_distance) break;
            if (is_released(j) && before.labels()[i] == before.labels()[j])
                sets.unite(static_cast<point_index>(i), j);
        }
    }
    const segments groups = segments_of(sets, options.min_points, is_released);
    for (std::size_t g = 0; g < groups.size(); ++g)
        for (const point_index i : groups[g])
            labels[i] = static_cast<std::int32_t>(before.size() + g);
    return labels;
}

}  // namespace detail

/// The segments without those points of flat ones that are not of their planes. Where enough of
/// these hang together, such as a mug on a table, they are a segment of their own. Segments that
/// are thicker than twice `sigma`, slimmer than it, or would lose more than a third of their
/// points, are no planes, and keep them all.
///
/// @param points   any point range of n points [m]; where view points are known, noise lies along
///                 the rays, else it is the same in all directions
/// @param surface  a normal for each, of either sign; points without one are judged without
/// @param parts    segments of these points
/// @return the segments, largest first; the same bytes for every execution
/// @throws std::invalid_argument  if points, surface, segments or view points differ in number, or
///                                unless sigma is greater than 0, k at least 1, max_distance not
///                                negative, and max_angle in [0, 90] degrees
/// Complexity: O(n log n), and O(k log k) for each point whose normal disagrees.
template <class R, normal_range Surface, execution X = sequential, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments release_strays(const R& points, const Surface& surface,
                                      const segments& parts, const stray_releasing& options = {},
                                      const X& run = {}, Proj projection = {}) {
    const position_view<R, Proj> p(points, projection);
    detail::require(parts.labels().size() == p.size(),
                    "release_strays: the segments are of other points");
    detail::require(std::ranges::size(surface) == p.size(),
                    "release_strays: the surface is of other points");
    detail::require(options.sigma > 0.0, "release_strays: sigma must be greater than 0");
    detail::require(options.k > 0, "release_strays: k must be at least 1");
    detail::require(options.max_distance >= 0.0,
                    "release_strays: max_distance must not be negative or NaN");
    const double cosine = detail::min_cosine(options.max_angle);
    const viewpoint_table viewpoints = viewpoints_of(points);
    const auto planes = detail::planes_of_segments(points, parts, options.sigma, run, projection);
    std::vector<bool> is_doubtful(p.size(), false);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        if (!planes[s].is_flat()) continue;
        for (const point_index i : parts[s]) {
            const Eigen::Vector3d normal = surface[i].normal;
            is_doubtful[i] = is_missing(normal) ||
                             !(std::abs(detail::dot(normal, planes[s].normal())) >= cosine);
        }
    }
    const adjacency graph =
        detail::graph_of_some(knn{options.k}, is_doubtful, points, run, projection);
    std::vector<std::int32_t> labels = parts.labels();
    run(parts.size(), [&](std::size_t s) {
        std::vector<point_index> released;
        for (const point_index i : parts[s])
            if (is_doubtful[i] &&
                !detail::is_on(p, viewpoints, graph, parts, i, planes[s], options.max_distance))
                released.push_back(i);
        if (3 * released.size() > parts[s].size()) return;
        for (const point_index i : released) labels[i] = unlabeled;
    });
    return detail::largest_first(
               segments(detail::with_released_groups(p, graph, parts, std::move(labels), options)))
        .first;
}

}  // namespace gnomon
