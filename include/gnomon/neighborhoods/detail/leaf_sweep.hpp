// SPDX-License-Identifier: BSL-1.0
/// @file
/// From group to group of a tree, in chunks that run side by side.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <gnomon/core/detail/instruction_set.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/detail/found_neighbors.hpp>
#include <gnomon/neighborhoods/detail/leaf_distances.hpp>
#include <gnomon/neighborhoods/detail/leaf_search.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/detail/place_search.hpp>

namespace gnomon::detail {
inline namespace GNOMON_LANES {

/// Calls search(group, visit) for all groups of a tree, with a search and a visitor for each chunk
/// of work, which make_search(tree) and make_visitor() give (generic, so that only users of a
/// search compile it). The visitor's finish(), if it has one, is called at the end of the chunk.
template <execution X>
void search_all_groups(const leaf_tree& tree, const X& run, auto&& make_search,
                       auto&& make_visitor) {
    constexpr std::size_t groups_per_chunk = 16;
    run((tree.groups() + groups_per_chunk - 1) / groups_per_chunk, [&](std::size_t chunk) {
        auto search = make_search(tree);
        auto visit = make_visitor();
        const std::size_t first = chunk * groups_per_chunk;
        const std::size_t last = std::min(first + groups_per_chunk, tree.groups());
        for (std::size_t group = first; group < last; ++group) search(group, visit);
        if constexpr (requires { visit.finish(); }) visit.finish();
    });
}

/// Shows a visitor of neighbors what was found of places.
template <class Visit>
class place_visitor {
  public:
    place_visitor(const leaf_tree& tree, Visit visit) : tree_(tree), visit_(std::move(visit)) {}

    void operator()(std::size_t place, std::span<const std::uint32_t> places) {
        visit_(tree_.index()[place], found_neighbors(tree_, place, places));
    }

    void finish() {
        if constexpr (requires { visit_.finish(); }) visit_.finish();
    }

  private:
    const leaf_tree& tree_;
    Visit visit_;
};

/// The sweep of a `sweeping_neighborhood`: visit(i, found_neighbors) for all points i of the tree
/// that a search finds neighbors of.
template <execution X>
void sweep_leaves(const leaf_tree& tree, const X& run, auto&& make_search, auto&& make_visitor) {
    search_all_groups(tree, run, make_search, [&] { return place_visitor(tree, make_visitor()); });
}

/// `leaf_search`, or where many points coincide `place_search`.
/// @tparam Distances  from what they are measured: see leaf_distances.hpp
template <class Tree, class Distances = distances_from_points<Tree>>
class nearest_search {
  public:
    nearest_search(const Tree& tree, const nearest_wanted& wanted)
        : nearest_search(tree, wanted, Distances(tree)) {}
    nearest_search(const Tree& tree, const nearest_wanted& wanted, const Distances& distances)
        : tree_(tree), by_leaf_(tree, wanted, distances), by_place_(tree, wanted, distances) {}

    void operator()(std::size_t group, auto&& visit) {
        if (tree_.crowded())
            by_place_(group, visit);
        else
            by_leaf_(group, visit);
    }

  private:
    const Tree& tree_;
    leaf_search<Tree, Distances> by_leaf_;
    place_search<Tree, Distances> by_place_;
};

/// The sweep of a search for the k nearest.
template <execution X>
void sweep_nearest(const leaf_tree& tree, const nearest_wanted& wanted, const X& run,
                   auto&& make_visitor) {
    sweep_leaves(
        tree, run, [&](const auto& of) { return nearest_search(of, wanted); }, make_visitor);
}

}  // namespace GNOMON_LANES
}  // namespace gnomon::detail
