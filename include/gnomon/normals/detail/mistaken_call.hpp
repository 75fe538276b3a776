// SPDX-License-Identifier: BSL-1.0
/// @file
/// The remedy in the first line of the compiler's output for calls of estimate_normals whose
/// arguments are in another order or of another kind than (points, neighborhood, estimator).
#pragma once

#include <functional>
#include <type_traits>

#include <gnomon/core/detail/refused_points.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/normals/estimator.hpp>

namespace gnomon::detail {

/// estimate_normals(graph, points, ...)
template <class R, class N, class Proj>
concept graph_before_points = neighborhood_graph<R> && point_range<N, Proj>;

/// estimate_normals(neighborhood, points, ...)
template <class R, class N, class Proj>
concept neighborhood_before_points = !indexed_range<R> && point_range<N, Proj>;

/// Neither a neighborhood of these points nor a graph.
template <class N, class R, class Proj>
concept no_neighborhood = !neighborhood<N, R, Proj> && !neighborhood_graph<N>;

/// estimate_normals(points, neighborhood, execution)
template <class E>
concept execution_before_estimator = !estimator<E> && execution<E>;

/// Whether explain_mistaken_call has a remedy for these arguments of estimate_normals. Other types
/// that are no estimators are not among them. A variable, so that compilers do not list its terms
/// where they report other errors.
template <class R, class N, class E, class Proj = std::identity, class X = sequential>
inline constexpr bool mistaken_call =
    !execution<X> || graph_before_points<R, N, Proj> || neighborhood_before_points<R, N, Proj> ||
    refused_points<R, Proj> || (point_range<R, Proj> && no_neighborhood<N, R, Proj>) ||
    execution_before_estimator<E>;

/// Does not compile: the static assertion names the remedy. Its return type is deduced, so that
/// compilers instantiate it where it is called, before they complain about the result.
/// Precondition: mistaken_call.
template <class R, class N, class E, class Proj = std::identity, class X = sequential>
constexpr auto explain_mistaken_call() {
    if constexpr (!execution<X> && std::is_arithmetic_v<X>) {
        static_assert(never<X>, "a number is not an execution: write gnomon::threads{4}");
    } else if constexpr (!execution<X>) {
        static_assert(never<X>,
                      "the execution comes before the projection: estimate_normals(points, "
                      "neighborhood, estimator, {}, projection)");
    } else if constexpr (graph_before_points<R, N, Proj>) {
        static_assert(never<R>,
                      "the points come before the graph: estimate_normals(points, graph, "
                      "estimator)");
    } else if constexpr (neighborhood_before_points<R, N, Proj>) {
        static_assert(never<R>,
                      "the points come before the neighborhood: estimate_normals(points, "
                      "neighborhood, estimator)");
    } else if constexpr (refused_points<R, Proj>) {
        (void)explain_refused_points<R, Proj>();
    } else if constexpr (no_neighborhood<N, R, Proj> && std::is_integral_v<N>) {
        static_assert(never<N>, "a number is not a neighborhood: write gnomon::knn{.k = 20}");
    } else if constexpr (no_neighborhood<N, R, Proj> && std::is_floating_point_v<N>) {
        static_assert(never<N>, "a number is not a neighborhood: write gnomon::radius{.r = 0.1}");
    } else if constexpr (no_neighborhood<N, R, Proj> && estimator<N>) {
        static_assert(never<N>,
                      "the neighborhood comes before the estimator: estimate_normals(points, "
                      "gnomon::knn{.k = 30}, estimator)");
    } else if constexpr (no_neighborhood<N, R, Proj>) {
        static_assert(never<N>,
                      "the second argument is neither a neighborhood, e.g. gnomon::knn{.k = 30}, "
                      "nor a graph");
    } else {
        static_assert(never<E>,
                      "the execution comes after the estimator: estimate_normals(points, "
                      "neighborhood, estimator, execution)");
    }
    return nullptr;
}

/// The estimate that the caller expects, so that the mistake is the only error.
template <class N, class E>
constexpr auto expected_estimate() {
    if constexpr (estimator<E>) {
        return estimate_t<E>{};
    } else if constexpr (estimator<N>) {
        return estimate_t<N>{};
    } else {
        return normal_fit{};
    }
}

}  // namespace gnomon::detail
