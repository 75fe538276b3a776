// SPDX-License-Identifier: BSL-1.0
/// @file
/// What both forms of Alg. 4.3 need: which segments to compare, and segments of merged ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/point.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/neighborhoods/kd_tree.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Each flat segment with those `wanted` flat ones whose centroids are nearest, by their numbers,
/// ascending and each pair once; 0 stands for all of up to 300, and for 20 of more.
/// @param all      something of each segment
/// @param is_flat  of that
/// @param frame    the principal_frame of that
template <class Segment, class Frame = std::identity>
[[nodiscard]] std::vector<std::pair<point_index, point_index>> pairs_to_compare(
    const std::vector<Segment>& all, std::size_t wanted, auto&& is_flat, Frame&& frame = {}) {
    constexpr std::size_t not_many = 300, few = 20;
    std::vector<point_index> flat;
    std::vector<Eigen::Vector3d> centroids;
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (!std::invoke(is_flat, all[s])) continue;
        flat.push_back(static_cast<point_index>(s));
        centroids.push_back(std::invoke(frame, all[s]).centroid);
    }
    if (wanted == 0) wanted = flat.size() <= not_many ? flat.size() : few;
    const kd_tree tree(centroids);
    std::vector<neighbor> nearest;
    std::vector<std::pair<point_index, point_index>> pairs;
    for (std::size_t f = 0; f < flat.size(); ++f) {
        tree.nearest(centroids[f], wanted, f, nearest);
        for (const neighbor& n : nearest) pairs.push_back(std::minmax(flat[f], flat[n.index]));
    }
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// The segments of n points, numbered as usual. (As a template, it costs only those who use it the
/// compilation of a sort.)
/// @param groups   something of each segment
/// @param members  the indices of its points, of that
template <class Members = std::identity>
[[nodiscard]] segments segments_of_groups(std::size_t n, const auto& groups,
                                          Members&& members = {}) {
    union_find sets(n);
    std::vector<bool> is_member(n, false);
    for (const auto& group : groups) {
        const auto& own = std::invoke(members, group);
        for (const point_index i : own) {
            sets.unite(own.front(), i);
            is_member[i] = true;
        }
    }
    return segments_of(sets, 1, [&](std::size_t i) { return bool{is_member[i]}; });
}

}  // namespace gnomon::detail
