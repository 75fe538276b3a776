// SPDX-License-Identifier: BSL-1.0
/// @file
/// Neighborhoods and graphs: the concepts of this floor.
///
/// A *neighborhood* is a small policy such as `knn{.k = 30}`. Called with points, or with a
/// `spatial_index` of them, it returns a *graph*, in which graph[i] are the indices of the
/// neighbors of point i (Klasing 2010, Sec. 3.2.2). An *indexed* neighborhood is a query on an
/// index: its member `find` returns the neighbors of one point and stores nothing else. A
/// *sweeping* neighborhood also searches for all points at once, in whatever order is fastest. The
/// three ways give the same neighbors. Some graphs also have a `neighborhood_note` for each point,
/// e.g. that its neighborhood ends at a boundary.
///
/// Laws, checked in tests/laws/neighborhood_laws.hpp for every model: i is not in graph[i]; indices
/// are valid and not repeated; a point that is not finite has no neighbors and is not a neighbor of
/// any point; the graph is the same bytes for every execution; `find` and `sweep` agree with the
/// graph.
///
/// Models: `knn`, `noise_knn`, `ray_knn`, `radius`, `hybrid` and `raster`, which sweep;
/// `adaptive_knn`, `delaunay` and `angularly_sorted`, which are indexed; graphs: `adjacency`, and
/// any std::vector<std::vector<point_index>>.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <type_traits>
#include <vector>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon {

/// Properties of a neighborhood in addition to its members.
struct neighborhood_note {
    bool open = false;      ///< last and first neighbor, in angular order, span a boundary
    bool certified = true;  ///< no point that the search did not read could change the neighborhood

    friend bool operator==(const neighborhood_note&, const neighborhood_note&) = default;
};

/// size() points, and for each i a sized range of the indices of its neighbors.
template <class G>
concept neighborhood_graph = requires(const G& graph, std::size_t i) {
    { graph.size() } -> std::convertible_to<std::size_t>;
    { *std::ranges::begin(graph[i]) } -> std::convertible_to<point_index>;
    { std::ranges::size(graph[i]) } -> std::convertible_to<std::size_t>;
};

/// A graph that has a note for each neighborhood.
template <class G>
concept annotated_graph = neighborhood_graph<G> && requires(const G& graph, std::size_t i) {
    { graph.note(i) } -> std::same_as<neighborhood_note>;
};

/// A policy that makes a graph of points: policy(points, execution, projection).
template <class N, class R, class Proj = std::identity>
concept neighborhood =
    point_range<R, Proj> && requires(const N& policy, const R& points, Proj proj) {
        { policy(points, sequential{}, proj) } -> neighborhood_graph;
    };

/// A neighborhood that is a query on an index: policy.find(index, i, found) replaces the content of
/// `found` by the neighbors of the finite point i and returns nothing or a `neighborhood_note`.
/// Const and thread-safe.
template <class N>
concept indexed_neighborhood =
    neighborhood<N, spatial_index> &&
    requires(const N& policy, const spatial_index& index, std::size_t i,
             std::vector<neighbor>& found) { policy.find(index, i, found); };

namespace detail {

struct any_visitor {
    void operator()(std::size_t, const auto&) const {}
};

}  // namespace detail

/// An indexed neighborhood that can also search for all points at once: policy.sweep(index,
/// execution, make_visitor) calls visit(i, found) for each finite point i, in any order and from
/// several threads, with a visitor that make_visitor() returns for each chunk of work, and at the
/// end of the chunk its finish(), if it has one. `found` is valid during the call: its `size()`;
/// the neighbors in the order of the policy, by `sort_into(neighbors)`, for vectors with any
/// allocator; and without that order, by `summed()`, their moments `about_point` and
/// `mean_distance`. A policy that finds the same number of neighbors of every one of n finite
/// points may return it from neighbors_of_each(n), an optional.
template <class N>
concept sweeping_neighborhood =
    indexed_neighborhood<N> && requires(const N& policy, const spatial_index& index) {
        policy.sweep(index, sequential{}, [] { return detail::any_visitor{}; });
    };

namespace detail {

/// What a graph notes of the neighborhood of point i; nothing, if it keeps no notes.
template <neighborhood_graph G>
[[nodiscard]] neighborhood_note note_of(const G& graph, std::size_t i) {
    if constexpr (annotated_graph<G>) {
        return graph.note(i);
    } else {
        return {};
    }
}

/// @throws std::invalid_argument  unless a graph is of this number of points, by their indices
void require_graph_of(std::size_t points, const auto& graph) {
    require(graph.size() == points, "graph and points differ in size");
    for (std::size_t i = 0; i < points; ++i)
        for (const point_index j : graph[i])
            require(j < points, "the graph has an index out of range");
}

/// Whether the policy's `find` returns notes.
template <class N>
concept notes_neighborhoods =
    requires(const N& policy, const spatial_index& index, std::vector<neighbor>& found) {
        { policy.find(index, std::size_t{}, found) } -> std::same_as<neighborhood_note>;
    };

/// Whether the policy's `find` takes vectors with any allocator.
template <class N>
concept finds_into_scratch = requires(const N& policy, const spatial_index& index,
                                      scratch<neighbor>& found) { policy.find(index, 0, found); };

/// Whether the policy sweeps over points without an index too, and faster: policy.sweep(points,
/// run, make_visitor, projection). policy.image_of(points) throws where it does not fit them.
template <class N>
concept needs_no_index = requires { requires N::needs_no_index; };

/// The vector for the neighbors that a policy finds: in scratch memory where that is possible.
template <class N>
using neighbor_buffer =
    std::conditional_t<finds_into_scratch<N>, scratch<neighbor>, std::vector<neighbor>>;

/// The neighbors of point i, finite or not, with their note.
template <indexed_neighborhood N, class Allocator>
neighborhood_note find_noted(const N& policy, const spatial_index& index, std::size_t i,
                             std::vector<neighbor, Allocator>& found) {
    if (index.tree().place_of(i) == leaf_tree::no_place) {
        found.clear();
        return notes_neighborhoods<N> ? neighborhood_note{.open = true, .certified = false}
                                      : neighborhood_note{};
    }
    if constexpr (notes_neighborhoods<N>) {
        return policy.find(index, i, found);
    } else {
        policy.find(index, i, found);
        return {};
    }
}

/// Throws what the policy throws for parameters out of range, whatever the points.
template <class N>
void require_valid(const N& policy) {
    if constexpr (requires { policy.require_valid(); }) policy.require_valid();
}

}  // namespace detail
}  // namespace gnomon
