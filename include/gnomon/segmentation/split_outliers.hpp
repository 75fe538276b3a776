// SPDX-License-Identifier: BSL-1.0
/// @file
/// Splits points off planar segments that are not on their planes: normals of a large neighborhood
/// turn slowly around the rim of a seat or a table top, so that a segmentation by normals includes
/// the rim, and of a surface that few scan lines meet, the rim may be a third.
///
/// A rim may be as narrow as noise is wide. But noise acts along the rays, so that its component
/// across a surface at oblique incidence is small; and the mean of a point and its neighbors is
/// more accurate than the point. Floors that are warped, or measured in steps, are off their planes
/// too: their normals are not. (Not in the thesis; assign_unlabeled is the reverse.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <iterator>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/detail/graph_of.hpp>
#include <gnomon/neighborhoods/detail/scratch_graph.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/noisy_plane.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `split_outliers`.
struct split_outliers_options {
    double sigma = 0.015;            ///< standard deviation of ranges [m]
    std::size_t k = 8;               ///< points are tested, and grouped, with their k nearest
    double max_distance = 0.30;      ///< that are no farther [m]
    angle max_angle = degrees(7.5);  ///< off the plane's: points with such a normal stay
    std::size_t min_points = 30;     ///< at least this number of released ones is a segment
};

namespace detail {

/// Whether point i of a segment is on its plane: the mean of it and its neighbors may be off by
/// four standard deviations of a mean, as many points are tested, and it by five of its own.
/// Neighbors that are farther off count as if by five, so that no single one decides; those of
/// another segment say nothing. What is not finite is off no plane.
[[nodiscard]] bool is_on(const auto& points, const viewpoint_table& viewpoints, const auto& graph,
                         const segments& parts, std::size_t i, const noisy_plane& of,
                         double max_distance) {
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

/// Labels the groups of adjacent points that had the same label before and have none now.
/// @param graph  the neighbors of each of these points
void label_released_groups(scratch<std::int32_t>& labels, const auto& points, const auto& graph,
                           const segments& before, const split_outliers_options& options) {
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
    const auto groups = labels_of_sets(sets, options.min_points, is_released);
    for (std::size_t i = 0; i < labels.size(); ++i)
        if (groups[i] != unlabeled)
            labels[i] = static_cast<std::int32_t>(before.size()) + groups[i];
}

/// split_outliers(index, surface, parts, options, run), in the memory of `result`, which may be
/// `parts`.
template <normal_range Surface, execution X>
void split_outliers_into(segments& result, const spatial_index& points, const Surface& surface,
                         const segments& parts, const split_outliers_options& options,
                         const X& run) {
    require(parts.labels().size() == points.size(),
            "split_outliers: the numbers of points and of labels differ");
    require(std::ranges::size(surface) == points.size(),
            "split_outliers: the numbers of points and of surface elements differ");
    require(options.sigma > 0.0, "split_outliers: sigma must be greater than 0");
    require(options.k > 0, "split_outliers: k must be at least 1");
    require(options.max_distance >= 0.0,
            "split_outliers: max_distance must not be negative or NaN");
    const double cosine = min_cosine(options.max_angle);
    const auto planes = planes_of_segments(points, parts, options.sigma, run);
    scratch<char> is_doubtful(points.size(), false);
    for (std::size_t s = 0; s < parts.size(); ++s) {
        if (!planes[s].is_flat()) continue;
        for (const point_index i : parts[s]) {
            const Eigen::Vector3d normal = surface[i].normal;
            is_doubtful[i] =
                is_missing(normal) || !(std::abs(dot(normal, planes[s].normal())) >= cosine);
        }
    }
    const scratch_graph graph = graph_of_some(
        options.k, [&](std::size_t i) { return is_doubtful[i] != 0; }, points, run);
    scratch<std::int32_t> labels(parts.labels().begin(), parts.labels().end());
    run(parts.size(), [&](std::size_t s) {
        scratch<point_index> released;
        for (const point_index i : parts[s])
            if (is_doubtful[i] != 0 &&
                !is_on(points, points.viewpoints, graph, parts, i, planes[s], options.max_distance))
                released.push_back(i);
        if (3 * released.size() > parts[s].size()) return;
        for (const point_index i : released) labels[i] = unlabeled;
    });
    label_released_groups(labels, points, graph, parts, options);
    number_by_size(labels);
    result.assign(labels);
}

}  // namespace detail

/// The segments without those points of flat ones that are not of their planes. Where enough of
/// these hang together, such as a mug on a table, they are a segment of their own. Segments that
/// are thicker than twice `sigma`, narrower than it, or would lose more than a third of their
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
[[nodiscard]] segments split_outliers(const R& points, const Surface& surface,
                                      const segments& parts,
                                      const split_outliers_options& options = {}, const X& run = {},
                                      Proj projection = {}) {
    const auto& team = detail::staying(run);
    segments result;
    detail::split_outliers_into(result, detail::index_of(points, team, projection), surface, parts,
                                options, team);
    return result;
}

}  // namespace gnomon
