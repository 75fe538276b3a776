// SPDX-License-Identifier: BSL-1.0
/// @file
/// Who is next to whom: the concepts of this floor.
///
/// A *neighborhood* is a small policy such as `knn{.k = 30}`; called with points it gives a
/// *graph*, in which the neighbors of point i are the indices graph[i] (Klasing 2010, Sec. 3.2.2).
/// A *streaming* neighborhood has a second door, `search`, that finds one ring at a time and stores
/// none; a *sweeping* one has a third, `sweep`, that finds all rings in whatever order is fastest.
/// All doors give the same rings. Some graphs know more of a ring than its members, e.g. that it
/// ends at a boundary: they say so in a `ring_note`.
///
/// Laws, checked in tests/laws/neighborhood_laws.hpp for every model: i is not in graph[i]; indices
/// are valid and not repeated; a point that is not finite has no neighbors and is nobody's; the
/// graph is the same bytes for every execution; all doors agree.
///
/// Models: `knn`, `radius` and `hybrid`, which have all three doors; `adaptive_knn`, `delaunay` and
/// `sorted_around`, which have the first two; graphs: `adjacency`, and any
/// std::vector<std::vector<point_index>>.
#pragma once

#include <concepts>
#include <cstddef>
#include <functional>
#include <iterator>
#include <vector>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>

namespace gnomon {

/// A point found by a search, in canonical order: by distance, ties by index.
struct neighbor {
    double squared_distance;  ///< [m^2], see squared_distance()
    point_index index;

    friend bool operator==(const neighbor&, const neighbor&) = default;
    friend bool operator<(const neighbor& a, const neighbor& b) {
        if (a.squared_distance != b.squared_distance)
            return a.squared_distance < b.squared_distance;
        return a.index < b.index;
    }
};

/// What becomes of points that are all as near as the k-th neighbor.
enum class tie_rule : bool {
    by_index,  ///< exactly k neighbors: of equals those of smaller index
    /// All of them, as long as no more than 2 k neighbors come together; equal is what differs by
    /// less than 1e-9 of the squared distance. The ring then depends neither on the order of the
    /// points nor on where the cloud lies and how it is turned, but for what moving it does to the
    /// last places of coordinates; also for depth cameras, whose quantised points are full of ties.
    all
};

/// What a graph may know of a ring besides its members.
struct ring_note {
    bool open = false;      ///< the last neighbor and the first do not enclose the surface
    bool certified = true;  ///< points that were not looked at could not change the ring

    friend bool operator==(const ring_note&, const ring_note&) = default;
};

/// size() points, and for each i a sized range of the indices of its neighbors.
template <class G>
concept neighborhood_graph = requires(const G& graph, std::size_t i) {
    { graph.size() } -> std::convertible_to<std::size_t>;
    { *std::ranges::begin(graph[i]) } -> std::convertible_to<point_index>;
    { std::ranges::size(graph[i]) } -> std::convertible_to<std::size_t>;
};

/// A graph that has a note for each ring.
template <class G>
concept annotated_graph = neighborhood_graph<G> && requires(const G& graph, std::size_t i) {
    { graph.note(i) } -> std::same_as<ring_note>;
};

/// Finds one ring at a time: search(i, ring) replaces the content of `ring` by the neighbors of
/// point i, in the order of the policy, and returns nothing or a `ring_note`. Const and
/// thread-safe.
template <class S>
concept neighbor_search = requires(const S& search, std::size_t i, std::vector<neighbor>& ring) {
    { search.size() } -> std::convertible_to<std::size_t>;
    search(i, ring);
};

/// A search that returns a note for each ring.
template <class S>
concept annotated_search =
    neighbor_search<S> && requires(const S& search, std::size_t i, std::vector<neighbor>& ring) {
        { search(i, ring) } -> std::same_as<ring_note>;
    };

/// What a graph notes of the ring of point i; nothing, if it keeps no notes.
template <neighborhood_graph G>
[[nodiscard]] ring_note note_of(const G& graph, std::size_t i) {
    if constexpr (annotated_graph<G>) {
        return graph.note(i);
    } else {
        return {};
    }
}

/// Calls search(i, ring) and returns its note.
template <neighbor_search S>
ring_note search_noted(const S& search, std::size_t i, std::vector<neighbor>& ring) {
    if constexpr (annotated_search<S>) {
        return search(i, ring);
    } else {
        search(i, ring);
        return {};
    }
}

namespace detail {

struct any_visitor {
    void operator()(std::size_t, const auto&) const {}
};

}  // namespace detail

/// A policy that makes a graph of points: policy(points, execution, projection).
template <class N, class R, class Proj = std::identity>
concept neighborhood =
    point_range<R, Proj> && requires(const N& policy, const R& points, Proj proj) {
        { policy(points, sequential{}, proj) } -> neighborhood_graph;
    };

/// A neighborhood that can also search without storing: policy.search(points, projection).
template <class N, class R, class Proj = std::identity>
concept streaming_neighborhood =
    neighborhood<N, R, Proj> && requires(const N& policy, const R& points, Proj proj) {
        { policy.search(points, proj) } -> neighbor_search;
    };

/// A neighborhood that can also find all rings at one sweep: policy.sweep(points, execution,
/// projection, make_visitor) calls visit(i, found) for each finite point i, with a visitor made for
/// each chunk of work (and in the end its finish(), if it has one), and returns whether it did. If
/// not, for the points are such that this would take too long, no visitor was called. What was
/// found tells, during the call, its `size()`, its ring by `sort_into(ring)`, and without that, by
/// `summed()`, its moments `about_point` and its `mean_distance`.
template <class N, class R, class Proj = std::identity>
concept sweeping_neighborhood =
    streaming_neighborhood<N, R, Proj> && requires(const N& policy, const R& points, Proj proj) {
        {
            policy.sweep(points, sequential{}, proj, [] { return detail::any_visitor{}; })
        } -> std::same_as<bool>;
    };

}  // namespace gnomon
