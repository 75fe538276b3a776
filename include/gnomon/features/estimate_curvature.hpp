// SPDX-License-Identifier: BSL-1.0
/// @file
/// Estimates the curvature at every point of a cloud, with any neighborhood and any curvature
/// estimator. The orientation of the normals determines the signs of the curvatures, so call
/// `orient_normals` first.
#pragma once

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
#include <gnomon/features/detail/trust_of_normal.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/neighbor_gatherer.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon {
namespace detail {

/// The curvature at p, with a trust no better than that of the normal. Enforces two laws on the
/// results of user-defined estimators: a usable result is finite, an unusable one is zero.
template <curvature_estimator C>
[[nodiscard]] curvature_result_t<C> checked_curvature(const C& estimate, const Eigen::Vector3d& p,
                                                      const auto& element,
                                                      neighborhood_view neighbors) {
    curvature_result_t<C> none;
    none.trust = trust_of_normal(element);
    if (!is_finite(p)) none.trust = trust::not_finite;
    if (!usable(none.trust)) return none;
    auto result = std::invoke(estimate, p, Eigen::Vector3d(element.normal), neighbors);
    double sum = result.gaussian() + result.mean();
    for (int i = 0; i < 3; ++i) sum += result.direction1[i] + result.direction2[i];
    if (usable(result.trust) && std::isfinite(sum)) {
        if (none.trust == trust::weak) result.trust = trust::weak;
        return result;
    }
    none.trust = usable(result.trust) ? trust::not_finite : result.trust;
    return none;
}

/// The curvature of every point.
/// @param neighborhoods  (i, buffer) to the neighbors of point i, from a graph or by a search
template <execution X, class Points, curvature_estimator C>
[[nodiscard]] auto curvatures_of(const X& run, const Points& points, auto&& neighborhoods,
                                 const auto& surface, const C& estimate) {
    require(std::ranges::size(surface) == points.size(),
            "estimate_curvature: surface and points differ in size");
    std::vector<curvature_result_t<C>> result(points.size());
    for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
        buffer_of<decltype(neighborhoods)> buffer;
        neighbor_gatherer gather(points, "estimate_curvature: the graph has an index out of range");
        for (std::size_t i = begin; i < end; ++i) {
            const neighborhood_view neighbors = gather(neighborhoods(i, buffer));
            result[i] = checked_curvature(estimate, points[i], surface[i], neighbors);
        }
    });
    return result;
}

}  // namespace detail

/// Estimates the curvature at every point from a stored neighbor graph.
///
/// @param points      any point range of n points, or the `spatial_index` of them
/// @param graph       the neighbors of each of the n points, indices below n
/// @param surface     n surface elements with oriented normals, such as the result of
///                    `estimate_normals`
/// @param estimate    any curvature estimator
/// @param run         `sequential{}` or `threads{n}`; the result does not depend on it
/// @param projection  maps an element of the range to a point
/// @return n results of the estimator [1/m], in the order of the points. If a normal is missing,
///         the trust is that of its surface element, or `degenerate` if the element has none; if
///         the trust of a normal is `weak`, so is that of the curvature.
/// @throws std::invalid_argument  if points, graph and surface differ in size, or an index of the
///                                graph is not below n
/// Complexity: n calls of the estimator. Source: Klasing 2010, Sec. 3.3.2.
template <class R, neighborhood_graph G, normal_range Surface,
          curvature_estimator C = shape_operator_curvature, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto estimate_curvature(const R& points, const G& graph, const Surface& surface,
                                      const C& estimate = {}, const X& run = {},
                                      Proj projection = {})
    -> std::vector<detail::curvature_result_t<C>> {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(graph.size() == p.size(),
                    "estimate_curvature: graph and points differ in size");
    return detail::curvatures_of(run, p, detail::stored_neighborhoods(graph), surface, estimate);
}

/// Estimates the curvature at every point from a neighborhood policy. If the policy searches
/// an index point by point, no graph is stored.
/// @param policy  any neighborhood; the other parameters and the result are as above
/// @throws std::invalid_argument  if a parameter of the policy is out of range, e.g. k = 0, or if
///                                points and surface differ in size
/// Complexity: n searches and n calls of the estimator.
template <class R, class N, normal_range Surface, curvature_estimator C = shape_operator_curvature,
          execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
[[nodiscard]] auto estimate_curvature(const R& points, const N& policy, const Surface& surface,
                                      const C& estimate = {}, const X& run = {},
                                      Proj projection = {})
    -> std::vector<detail::curvature_result_t<C>> {
    if constexpr (indexed_neighborhood<N> && !detail::needs_no_index<N>) {
        detail::require_valid(policy);
        const auto& team = detail::staying(run);
        const auto& index = detail::index_of(points, team, projection);
        return detail::curvatures_of(team, index, detail::found_neighborhoods(policy, index),
                                     surface, estimate);
    } else {
        return estimate_curvature(points, policy(points, run, projection), surface, estimate, run,
                                  projection);
    }
}

}  // namespace gnomon
