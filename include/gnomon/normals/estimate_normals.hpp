// SPDX-License-Identifier: BSL-1.0
/// @file
/// Normals for all points of a cloud, by any estimator over any neighborhood:
///
///     auto surface = gnomon::estimate_normals(scan);
///
///     auto surface = gnomon::estimate_normals(scan, knn{.k = 50}, plane_pca{}, threads{});
///
///     auto surface = gnomon::estimate_normals(index, knn{.k = 50}, plane_ekf{});
///
/// Klasing 2010, Sec. 3.2.
#pragma once

#include <cstddef>
#include <functional>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/detail/touched_vector.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/trust.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/detail/mistaken_call.hpp>
#include <gnomon/normals/detail/surfel_maker.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/surfel.hpp>

namespace gnomon {
namespace detail {

/// The default neighborhoods, as recommended in docs/normals.md.
template <class N>
[[nodiscard]] constexpr N usual_neighborhood() {
    if constexpr (std::is_same_v<N, knn>)
        return {.k = 30};
    else
        return {};
}

/// The surface elements of points, from what a sweep finds.
/// @param epsilon  machine epsilon of the numbers that the points came in
/// @param sweep    sweep(make_visitor), as a policy's `sweep`
template <estimator E, execution X>
void estimate_swept(std::vector<surfel<estimate_t<E>>>& surface, const auto& points,
                    const viewpoint_table& viewpoints, double epsilon, const E& estimate,
                    const X& run, auto&& sweep) {
    resize_touched(surface, points.size(), run);
    sweep([&] { return sweep_visitor(estimate, points, viewpoints, epsilon, surface); });
    for_each_chunk(run, points.size(), [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if constexpr (requires { points.is_finite(i); }) {  // an index knows
                if (points.is_finite(i)) continue;
            } else {
                if (is_finite(points[i])) continue;
            }
            surface[i] = {};
            surface[i].trust = trust::not_finite;
        }
    });
}

/// The surface elements of the points of an index, by an indexed neighborhood.
template <indexed_neighborhood N, estimator E, execution X>
void estimate_indexed(std::vector<surfel<estimate_t<E>>>& surface, const spatial_index& index,
                      const N& policy, const E& estimate, const X& run) {
    require_valid(policy);
    if constexpr (sweeping_neighborhood<N>) {
        estimate_swept(surface, index, index.viewpoints, index.epsilon(), estimate, run,
                       [&](auto&& make_visitor) { policy.sweep(index, run, make_visitor); });
    } else {
        resize_touched(surface, index.size(), run);
        estimate_at(run, index.size(), std::identity{}, index, index.viewpoints, index.epsilon(),
                    found_neighborhoods(policy, index), estimate, surface);
    }
}

}  // namespace detail

/// The surface elements of all points, in their order, from a stored graph.
///
/// @param points      any point range of n points, or an index of them; ray estimators ask a scan,
///                    or what with_viewpoint(s) returns, for its view points and otherwise assume
///                    the origin
/// @param graph       the neighbors of each of the n points, indices below n
/// @param estimate    any estimator; by default `plane_pca`
/// @param run         `sequential{}`, `threads{n}` or another execution; the bytes of the
///                    result are the same
/// @param projection  makes a point of an element of the range
/// @return n surface elements; a point without a usable normal has the zero vector and a trust that
///         says why. `weak` as well where an ulp of the coordinates exceeds 5 % of the mean
///         neighbor distance (float points far from the origin) or the neighborhood is not
///         certified; `not_finite` as well where a ray estimator has a view point that is not
///         finite.
/// @throws std::invalid_argument  if graph and points differ in size, an index is out of range, or
///                                the view points are for another number of points
/// Complexity: one call of the estimator per point.
template <class R, neighborhood_graph G, estimator E = plane_pca, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] auto estimate_normals(const R& points, const G& graph, const E& estimate = {},
                                    const X& run = {}, Proj projection = {})
    -> std::vector<surfel<estimate_t<E>>> {
    std::vector<surfel<estimate_t<E>>> surface;
    estimate_normals_into(surface, points, graph, estimate, run, std::move(projection));
    return surface;
}

/// estimate_normals(points, graph, estimate, run, projection), in the memory of `surface`, whose
/// content it replaces; allocates only to grow.
/// Errors and complexity: those of that form.
template <class R, neighborhood_graph G, estimator E, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
void estimate_normals_into(std::vector<surfel<estimate_t<E>>>& surface, const R& points,
                           const G& graph, const E& estimate, const X& run = {},
                           Proj projection = {}) {
    const position_view<R, Proj> p(points, std::move(projection));
    detail::require(graph.size() == p.size(), "estimate_normals: graph and points differ in size");
    detail::resize_touched(surface, p.size(), run);
    detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
        detail::estimate_at(run, p.size(), std::identity{}, p, viewpoints,
                            detail::epsilon_of<position_view<R, Proj>>(points),
                            detail::stored_neighborhoods(graph), estimate, surface);
    });
}

/// estimate_normals(points, policy, estimate, run, projection), in the memory of `surface`, whose
/// content it replaces. With an index that is rebuilt for each scan, repeated calls allocate only
/// what a search needs while it runs.
/// Errors and complexity: those of that form.
template <class R, class N, estimator E, execution X = sequential, class Proj = std::identity>
    requires neighborhood<N, R, Proj>
void estimate_normals_into(std::vector<surfel<estimate_t<E>>>& surface, const R& points,
                           const N& policy, const E& estimate, const X& run = {},
                           Proj projection = {}) {
    const auto& team = detail::staying(run);
    if constexpr (detail::needs_no_index<N>) {
        const position_view<R, Proj> p(points, projection);
        (void)policy.image_of(points);  // throws before anything is overwritten
        detail::with_table_of(points, [&](const viewpoint_table& viewpoints) {
            detail::estimate_swept(
                surface, p, viewpoints, detail::epsilon_of<position_view<R, Proj>>(points),
                estimate, team,
                [&](auto&& make_visitor) { policy.sweep(points, team, make_visitor, projection); });
        });
    } else if constexpr (indexed_neighborhood<N>) {
        const auto& index = detail::index_of(points, team, projection);
        detail::estimate_indexed(surface, index, policy, estimate, team);
    } else {
        estimate_normals_into(surface, points, policy(points, team, projection), estimate, team,
                              std::move(projection));
    }
}

/// The same from a neighborhood policy; an indexed one stores no graph. estimate_normals(points)
/// takes the 30 nearest neighbors and `plane_pca`.
/// @throws std::invalid_argument  also if the policy's parameters are out of range, e.g. k = 0
/// Complexity: one search and one call of the estimator per point, and the index if `points` is
/// none.
template <class R, class N = knn, estimator E = plane_pca, execution X = sequential,
          class Proj = std::identity>
    requires neighborhood<N, R, Proj>
[[nodiscard]] auto estimate_normals(const R& points,
                                    const N& policy = detail::usual_neighborhood<N>(),
                                    const E& estimate = {}, const X& run = {}, Proj projection = {})
    -> std::vector<surfel<estimate_t<E>>> {
    std::vector<surfel<estimate_t<E>>> surface;
    estimate_normals_into(surface, points, policy, estimate, run, std::move(projection));
    return surface;
}

/// Refused, with the remedy in the first line: other points, a number for a neighborhood, arguments
/// in another order.
template <class R, class N = knn, class E = plane_pca, class X = sequential,
          class Proj = std::identity>
    requires(detail::mistaken_call<R, N, E, Proj, X>)
auto estimate_normals(const R&, const N& = {}, const E& = {}, const X& = {}, const Proj& = {}) {
    (void)detail::explain_mistaken_call<R, N, E, Proj, X>();
    return std::vector<surfel<decltype(detail::expected_estimate<N, E>())>>{};
}

/// Refused: an estimator is called as e(point, neighbors) or e(point, neighbors, viewpoint) and
/// returns a `normal_estimate` or a bare 3-vector.
template <class R, class N, class E>
    requires(!estimator<E> && !detail::mistaken_call<R, N, E>)
void estimate_normals(const R& points, const N& neighborhood, const E& not_an_estimator,
                      const auto&... others) = delete;

}  // namespace gnomon
