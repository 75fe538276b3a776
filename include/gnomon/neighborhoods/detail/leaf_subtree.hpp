// SPDX-License-Identifier: BSL-1.0
/// @file
/// A node of a tree in preorder without pointers: the leaves below it determine its children.
#pragma once

#include <array>
#include <cstddef>

namespace gnomon::detail {

/// A node by its number in preorder, and the leaves below it, from `first` to before `last`.
struct leaf_subtree {
    /// Leaves 4 g to 4 g + 3 are a subtree: nodes above are split between such groups.
    static constexpr std::size_t leaves_per_group = 4;

    std::size_t node, first, last;

    [[nodiscard]] std::size_t leaves() const { return last - first; }
    [[nodiscard]] bool is_leaf() const { return leaves() == 1; }

    /// Its children. Precondition: it is no leaf.
    [[nodiscard]] std::array<leaf_subtree, 2> children() const {
        const std::size_t half = (leaves() + 1) / 2;
        const std::size_t left =
            leaves() <= leaves_per_group
                ? half
                : (half + leaves_per_group - 1) / leaves_per_group * leaves_per_group;
        return {{{node + 1, first, first + left}, {node + 2 * left, first + left, last}}};
    }
};

}  // namespace gnomon::detail
