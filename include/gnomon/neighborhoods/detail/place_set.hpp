// SPDX-License-Identifier: BSL-1.0
/// @file
/// Some of the points of a tree: a bit for each, 32 bits for each leaf.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>

namespace gnomon::detail {

/// A set of places in a `leaf_tree`.
class place_set {
  public:
    place_set() = default;
    /// The places of the finite ones among some points.
    /// @throws std::invalid_argument  for an index out of range
    place_set(const leaf_tree& tree, std::span<const point_index> indices) {
        assign(tree, indices);
    }

    /// Makes it the set of the finite ones among some points.
    /// @throws std::invalid_argument  for an index out of range
    void assign(const leaf_tree& tree, std::span<const point_index> indices) {
        leaves_.assign(tree.leaves(), 0);
        for (const point_index i : indices) {
            require(i < tree.points(), "an index of a point is out of range");
            insert(tree.place_of(i));
        }
        count();
    }

    /// Makes it the set of the finite points i for which wanted(i) holds.
    void assign_if(const leaf_tree& tree, auto&& wanted) {
        leaves_.assign(tree.leaves(), 0);
        for (std::size_t place = 0; place < tree.size(); ++place)
            if (wanted(tree.index()[place])) insert(static_cast<point_index>(place));
        count();
    }

    /// The number of places.
    [[nodiscard]] std::size_t size() const { return before_.empty() ? 0 : before_.back(); }
    [[nodiscard]] bool contains(std::size_t place) const {
        return (leaves_[place / leaf_tree::leaf_size] >> place % leaf_tree::leaf_size & 1u) != 0;
    }
    /// Whether it has a place in the leaves below a node.
    [[nodiscard]] bool meets(const leaf_subtree& node) const {
        return before_[node.first] != before_[node.last];
    }
    /// The number of places of the set before this one.
    [[nodiscard]] std::size_t rank(std::size_t place) const {
        const std::size_t leaf = place / leaf_tree::leaf_size;
        const std::uint32_t lower = (std::uint32_t{1} << place % leaf_tree::leaf_size) - 1;
        return before_[leaf] + static_cast<std::size_t>(std::popcount(leaves_[leaf] & lower));
    }
    /// Bit l stands for the l-th place of a leaf.
    [[nodiscard]] std::uint32_t of_leaf(std::size_t leaf) const { return leaves_[leaf]; }

  private:
    void insert(point_index place) {
        if (place == leaf_tree::no_place) return;
        leaves_[place / leaf_tree::leaf_size] |= std::uint32_t{1} << place % leaf_tree::leaf_size;
    }

    void count() {
        before_.resize(leaves_.size() + 1);
        before_[0] = 0;
        for (std::size_t l = 0; l < leaves_.size(); ++l)
            before_[l + 1] = before_[l] + static_cast<std::uint32_t>(std::popcount(leaves_[l]));
    }

    static_assert(leaf_tree::leaf_size == 32);
    scratch<std::uint32_t> leaves_;
    /// For each leaf, the number of places in the leaves before it; at last, that of all places.
    scratch<std::uint32_t> before_;
};

}  // namespace gnomon::detail
