// SPDX-License-Identifier: BSL-1.0
/// @file
/// The nearest neighbors of all points of a group, one point after the other: for trees in which
/// many points coincide, where `leaf_search` would read all of them for each leaf.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/neighborhoods/detail/leaf_distances.hpp>
#include <gnomon/neighborhoods/detail/nearest_wanted.hpp>
#include <gnomon/neighborhoods/detail/tree_query.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>

namespace gnomon::detail {

/// Searches as `leaf_search` does; each thread has its own object.
/// @tparam Distances  from what they are measured: see leaf_distances.hpp
template <class Tree, class Distances = distances_from_points<Tree>>
class place_search {
  public:
    place_search(const Tree& tree, const nearest_wanted& wanted, const Distances& distances)
        : tree_(tree), wanted_(wanted), distances_(distances) {}

    /// Calls visit(place, places of its nearest neighbors) for each query point in a group.
    void operator()(std::size_t group, auto&& visit) {
        const std::size_t first = group * Tree::points_per_group;
        const std::size_t last = std::min(first + Tree::points_per_group, tree_.size());
        for (std::size_t p = first; p < last; ++p) {
            if (wanted_.of != nullptr && !wanted_.of->contains(p)) continue;
            const auto [x, y, z] = tree_.position(p);
            search_tree(tree_, {x, y, z},
                        {.k = wanted_.k,
                         .squared_radius = wanted_.radius * wanted_.radius,
                         .ties = wanted_.ties,
                         .except = tree_.index()[p]},
                        found_, distances_.metric_at(p));
            places_.resize(found_.size());
            for (std::size_t q = 0; q < found_.size(); ++q)
                places_[q] = tree_.place_of(found_[q].index);
            visit(p, std::span<const std::uint32_t>(places_));
        }
    }

  private:
    const Tree& tree_;
    nearest_wanted wanted_;
    Distances distances_;
    scratch<neighbor> found_;
    scratch<std::uint32_t> places_;
};

}  // namespace gnomon::detail
