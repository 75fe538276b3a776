// SPDX-License-Identifier: BSL-1.0
/// @file
/// The points of a scan within the bounds of an object at a pose.
#pragma once

#include <algorithm>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/neighborhoods/detail/leaf_box.hpp>
#include <gnomon/neighborhoods/detail/leaf_tree.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>

namespace gnomon::recognition::detail {

/// The box of the outer frame around a box of the local frame.
[[nodiscard]] inline gnomon::detail::leaf_box box_around(const rigid_motion& pose,
                                                         const Eigen::Vector3d& low,
                                                         const Eigen::Vector3d& high) {
    gnomon::detail::leaf_box box{};
    for (int i = 0; i < 3; ++i) {
        double middle = pose.position[i], reach = 0.0;
        for (int j = 0; j < 3; ++j) {
            middle += pose.rotation(i, j) * 0.5 * (low[j] + high[j]);
            reach += std::abs(pose.rotation(i, j)) * 0.5 * (high[j] - low[j]);
        }
        box.low[static_cast<std::size_t>(i)] = middle - reach;
        box.high[static_cast<std::size_t>(i)] = middle + reach;
    }
    return box;
}

/// Calls visit(point_index, Eigen::Vector3d) for the finite points in a box of the local frame,
/// with their coordinates in it, in the order of the index.
void for_each_point_in(const spatial_index& index, const rigid_motion& pose,
                       const Eigen::Vector3d& low, const Eigen::Vector3d& high, const auto& visit) {
    const auto& tree = index.tree();
    if (tree.size() == 0 || !(low.array() <= high.array()).all()) return;
    tree.for_each_leaf_near(box_around(pose, low, high), 0.0, [&](std::size_t leaf, const auto&) {
        const std::size_t begin = leaf * gnomon::detail::leaf_tree::leaf_size;
        const std::size_t end = std::min(begin + gnomon::detail::leaf_tree::leaf_size, tree.size());
        for (std::size_t place = begin; place < end; ++place) {
            const auto p = tree.position(place);
            const Eigen::Vector3d x = pose.point_in({p[0], p[1], p[2]});
            bool is_inside = true;
            for (int a = 0; a < 3; ++a) is_inside = is_inside && low[a] <= x[a] && x[a] <= high[a];
            if (is_inside) visit(tree.index()[place], x);
        }
    });
}

}  // namespace gnomon::recognition::detail
