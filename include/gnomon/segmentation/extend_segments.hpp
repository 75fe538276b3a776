// SPDX-License-Identifier: BSL-1.0
/// @file
/// Extends smooth segments to their borders: they end a few points before an edge, where normals
/// are blended, and have holes where normals are noisy. Such unlabeled points are assigned to the
/// adjacent segment whose tangent planes they lie on, layer by layer. Labeled points keep their
/// segment.
///
/// The last step of region growing in two thresholds (hysteresis): strict where surfaces are found,
/// lenient where they are only extended.
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
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `extend_segments`.
struct extend_segments_options {
    angle max_angle = degrees(20);  ///< between the normals of a point and of its new neighbors
    int neighborhoods = 10;         ///< the largest number of layers
};

namespace detail {

/// The segment, among those of the neighbors whose normals agree, with the least mean distance of
/// point i from its tangent planes; unlabeled if there is none. Ties go to the smaller label.
template <class Points, neighborhood_graph G, normal_range Surface>
[[nodiscard]] std::int32_t nearest_segment(const Points& p, const G& graph, const Surface& surface,
                                           const std::vector<std::int32_t>& labels, std::size_t i,
                                           double min_cosine,
                                           std::vector<std::pair<std::int32_t, double>>& votes) {
    votes.clear();
    for (const point_index j : graph[i]) {
        const Eigen::Vector3d& n_j = surface[j].normal;
        if (labels[j] == unlabeled || is_missing(n_j) || !is_finite(p[j])) continue;
        if (std::abs(dot(surface[i].normal, n_j)) >= min_cosine)
            votes.emplace_back(labels[j], std::abs(dot(n_j, difference(p[i], p[j]))));
    }
    std::sort(votes.begin(), votes.end());
    std::int32_t best = unlabeled;
    double least = 0.0;
    for (auto first = votes.begin(); first != votes.end();) {
        auto last = first;
        double sum = 0.0;
        for (; last != votes.end() && last->first == first->first; ++last) sum += last->second;
        const double mean = sum / static_cast<double>(last - first);
        if (best == unlabeled || mean < least) {
            best = first->first;
            least = mean;
        }
        first = last;
    }
    return best;
}

}  // namespace detail

/// The segments, extended by adjacent unlabeled points.
///
/// @param points   any point range of n points
/// @param graph    the neighbors of each: few, as each layer reaches one neighbor farther
/// @param surface  a normal for each; points without one are left as they are
/// @param found    segments of the n points
/// @return the same segments, extended, largest first
/// @throws std::invalid_argument  if points, graph, surface and segments differ in size, the graph
///                                has an index out of range, or max_angle is outside [0, 90]
///                                degrees
/// Complexity: O(n k) for each layer. The same bytes for every execution.
template <class R, neighborhood_graph G, normal_range Surface, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] segments extend_segments(const R& points, const G& graph, const Surface& surface,
                                       const segments& found,
                                       const extend_segments_options& options = {},
                                       const X& run = {}, Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(graph.size() == p.size(), "extend_segments: graph and points differ in size");
    detail::require(std::ranges::size(surface) == p.size(),
                    "extend_segments: surface and points differ in size");
    detail::require(found.labels().size() == p.size(),
                    "extend_segments: segments and points differ in number");
    const double cosine = detail::min_cosine(options.max_angle);
    for (std::size_t i = 0; i < p.size(); ++i) {
        for (const point_index j : graph[i])
            detail::require(j < p.size(), "extend_segments: the graph has an index out of range");
    }

    std::vector<std::int32_t> labels = found.labels();
    for (int neighbors = 0; neighbors < options.neighborhoods; ++neighbors) {
        std::vector<std::int32_t> next = labels;
        detail::for_each_chunk(run, p.size(), [&](std::size_t begin, std::size_t end) {
            std::vector<std::pair<std::int32_t, double>> votes;
            for (std::size_t i = begin; i < end; ++i) {
                if (labels[i] != unlabeled || !is_finite(p[i]) || is_missing(surface[i].normal))
                    continue;
                next[i] = detail::nearest_segment(p, graph, surface, labels, i, cosine, votes);
            }
        });
        if (next == labels) break;
        labels = std::move(next);
    }
    detail::number_by_size(labels);
    return segments(std::move(labels));
}

}  // namespace gnomon
