// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the tree-based policies share: points with a kd-tree over them.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>

namespace gnomon::detail {

/// Models `neighbor_search`: asks `policy.find` for the ring of each finite point.
template <class Policy, class R, class Proj>
class tree_search {
  public:
    tree_search(const Policy& policy, const R& points, Proj projection)
        : policy_(policy), points_(points, projection), tree_(points, std::move(projection)) {}

    [[nodiscard]] std::size_t size() const { return points_.size(); }

    void operator()(std::size_t i, std::vector<neighbor>& ring) const {
        ring.clear();
        const Eigen::Vector3d p = points_[i];
        if (is_finite(p)) policy_.find(tree_, p, i, ring);
    }

  private:
    Policy policy_;
    position_view<R, Proj> points_;
    kd_tree tree_;
};

}  // namespace gnomon::detail
