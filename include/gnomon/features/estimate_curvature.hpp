// SPDX-License-Identifier: BSL-1.0
/// @file
/// Curvatures for all points of a cloud: any neighborhood, any curvature estimator, one loop for
/// all of them. Orient the normals first (`orient_normals`): their side decides the signs.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/features/curvature.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/detail/ring_gatherer.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {
namespace detail {

/// Why the normal of a surface element is missing or how far it can be trusted, if it tells.
[[nodiscard]] trust trust_of_normal(const auto& element) {
    if constexpr (requires {
                      { element.trust } -> std::convertible_to<trust>;
                  }) {
        return element.trust;
    } else {
        return is_missing(element.normal) ? trust::degenerate : trust::good;
    }
}

/// The curvature at p, no more trusted than its normal, and with the promises kept that an
/// estimator may have broken: usable is finite, unusable is zero.
template <curvature_estimator C>
[[nodiscard]] curvature_result_t<C> checked_curvature(const C& estimate, const Eigen::Vector3d& p,
                                                      const auto& element, ring_view ring) {
    curvature_result_t<C> none;
    none.trust = trust_of_normal(element);
    if (!is_finite(p)) none.trust = trust::not_finite;
    if (!usable(none.trust)) return none;
    auto result = std::invoke(estimate, p, Eigen::Vector3d(element.normal), ring);
    double sum = result.gaussian() + result.mean();
    for (int i = 0; i < 3; ++i) sum += result.direction1[i] + result.direction2[i];
    if (usable(result.trust) && std::isfinite(sum)) {
        if (none.trust == trust::weak) result.trust = trust::weak;
        return result;
    }
    none.trust = usable(result.trust) ? trust::not_finite : result.trust;
    return none;
}

/// One curvature per point, from `rings`, stored or found.
template <execution X, class Points, curvature_estimator C>
[[nodiscard]] auto curvatures_of(const X& run, const Points& points, auto&& rings,
                                 const auto& surface, const C& estimate) {
    require(std::ranges::size(surface) == points.size(),
            "estimate_curvature: the surface is of other points");
    std::vector<curvature_result_t<C>> result(points.size());
    for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
        std::vector<neighbor> buffer;
        ring_gatherer gather(points, "estimate_curvature: the graph lists a neighbor of no point");
        for (std::size_t i = begin; i < end; ++i) {
            const ring_view ring = gather(rings(i, buffer));
            result[i] = checked_curvature(estimate, points[i], surface[i], ring);
        }
    });
    return result;
}

}  // namespace detail

/// The curvatures of all points, in their order: from a stored graph.
///
/// @param points      any point range of n points
/// @param graph       the neighbors of each of the n points, indices below n
/// @param surface     a normal for each point, such as estimate_normals gives, oriented
/// @param estimate    any curvature estimator
/// @param run         `sequential{}` or `threads{n}`; the result is the same bytes
/// @param projection  makes a point of an element of the range
/// @return n results of the estimator. Where the normal is missing the trust is that of the normal
///         if its element has one, and `degenerate` if not; where it is weak, so is the curvature.
/// @throws std::invalid_argument  if points, graph and surface differ in size, or an index is of no
///                                point
/// Complexity: one call of the estimator per point. Source: Klasing 2010, Sec. 3.3.2.
template <class R, neighborhood_graph G, normal_range Surface,
          curvature_estimator C = shape_operator_curvature, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto estimate_curvature(const R& points, const G& graph, const Surface& surface,
                                      const C& estimate = {}, const X& run = {},
                                      Proj projection = {}) -> std::vector<curvature_result_t<C>> {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(graph.size() == p.size(), "estimate_curvature: the graph is of other points");
    return detail::curvatures_of(run, p, detail::stored_rings(graph), surface, estimate);
}

/// The same from a neighborhood policy: searched and estimated point by point, nothing stored if
/// the policy streams.
/// @throws std::invalid_argument  if the policy's parameters are out of range, e.g. k = 0
/// Complexity: one search and one call of the estimator per point.
template <class R, class N, normal_range Surface, curvature_estimator C = shape_operator_curvature,
          execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
[[nodiscard]] auto estimate_curvature(const R& points, const N& policy, const Surface& surface,
                                      const C& estimate = {}, const X& run = {},
                                      Proj projection = {}) -> std::vector<curvature_result_t<C>> {
    if constexpr (streaming_neighborhood<N, R, Proj>) {
        const position_view<R, Proj> p(points, projection);
        const auto search = policy.search(points, projection);
        return detail::curvatures_of(run, p, detail::found_rings(search), surface, estimate);
    } else {
        return estimate_curvature(points, policy(points, run, projection), surface, estimate, run,
                                  projection);
    }
}

}  // namespace gnomon
