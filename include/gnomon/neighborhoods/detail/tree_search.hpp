// SPDX-License-Identifier: BSL-1.0
/// @file
/// The search of all policies that ask a kd-tree. Such a policy has a member
/// find(tree, points, i, ring), which replaces the content of `ring` by the neighbors of point i, a
/// finite one of the `points` that the tree is of, and returns nothing or a `ring_note`.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

/// Models `neighbor_search`, and `annotated_search` if the policy's `find` returns notes. What is
/// not finite has no neighbors, and nothing certifies that.
template <class Policy, class R, class Proj>
class tree_search {
  public:
    tree_search(const Policy& policy, const R& points, Proj projection)
        : policy_(policy), points_(points, projection), tree_(points, std::move(projection)) {}

    [[nodiscard]] std::size_t size() const { return points_.size(); }

    auto operator()(std::size_t i, std::vector<neighbor>& ring) const {
        if (is_finite(points_[i])) return policy_.find(tree_, points_, i, ring);
        ring.clear();
        using note = decltype(policy_.find(tree_, points_, i, ring));
        if constexpr (!std::is_void_v<note>) return note{.open = true, .certified = false};
    }

  private:
    Policy policy_;
    position_view<R, Proj> points_;
    kd_tree tree_;
};

}  // namespace gnomon::detail
