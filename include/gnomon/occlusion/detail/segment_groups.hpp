// SPDX-License-Identifier: BSL-1.0
/// @file
/// What both forms of Alg. 4.3 need: which segments to compare, and segments of merged ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The pairs of each of some points with its k nearest ones, k less than their number minus 1.
/// O(m log m) for m points, O(m^2) for few of them.
/// @param number  what to call each point in the pairs
void append_nearest_pairs(auto& pairs, const auto& points, std::size_t k, const auto& number) {
    constexpr std::size_t few = 2000;  // performance only: no index, thus no allocation
    const std::size_t m = points.size();
    const spatial_index index = m > few ? spatial_index(points) : spatial_index();
    scratch<neighbor> nearest;
    for (std::size_t f = 0; f < m; ++f) {
        if (m > few) {
            knn{.k = k}.find(index, f, nearest);
        } else {
            nearest.clear();
            for (std::size_t g = 0; g < m; ++g)
                if (g != f)
                    nearest.push_back(
                        {squared_distance(points[g], points[f]), static_cast<point_index>(g)});
            std::nth_element(nearest.begin(), nearest.begin() + static_cast<std::ptrdiff_t>(k),
                             nearest.end());
            nearest.resize(k);
        }
        for (const neighbor& n : nearest) pairs.push_back(std::minmax(number[f], number[n.index]));
    }
}

/// Each flat segment with those `wanted` flat ones whose centroids are nearest, by their numbers,
/// ascending and each pair once; 0 stands for all of up to 300, and for 20 of more.
/// @param all      an object for each segment
/// @param is_flat  of that object
/// @param frame    the principal_frame of that object
template <class Frame = std::identity>
[[nodiscard]] scratch<std::pair<point_index, point_index>> pairs_to_compare(const auto& all,
                                                                            std::size_t wanted,
                                                                            auto&& is_flat,
                                                                            Frame&& frame = {}) {
    constexpr std::size_t not_many = 300, few = 20;  // performance only: k_c of the thesis is open
    scratch<point_index> flat;
    scratch<Eigen::Vector3d> centroids;
    for (std::size_t s = 0; s < all.size(); ++s) {
        if (!std::invoke(is_flat, all[s])) continue;
        flat.push_back(static_cast<point_index>(s));
        centroids.push_back(std::invoke(frame, all[s]).centroid);
    }
    if (wanted == 0) wanted = flat.size() <= not_many ? flat.size() : few;
    scratch<std::pair<point_index, point_index>> pairs;
    if (wanted + 1 >= flat.size()) {
        for (std::size_t f = 0; f < flat.size(); ++f)
            for (std::size_t g = f + 1; g < flat.size(); ++g) pairs.emplace_back(flat[f], flat[g]);
        return pairs;
    }
    append_nearest_pairs(pairs, centroids, wanted, flat);
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
    return pairs;
}

/// The labels of n points in disjoint groups, numbered as usual.
/// @param groups   an object for each segment
/// @param members  the indices of its points, of that object
template <class Members = std::identity>
[[nodiscard]] scratch<std::int32_t> labels_of_groups(std::size_t n, const auto& groups,
                                                     Members&& members = {}) {
    scratch<std::int32_t> labels(n, unlabeled);
    std::int32_t label = 0;
    for (const auto& group : groups) {
        for (const point_index i : std::invoke(members, group)) labels[i] = label;
        ++label;
    }
    number_by_size(labels);
    return labels;
}

/// The segments of n points in disjoint groups.
[[nodiscard]] segments segments_of_groups(std::size_t n, const auto& groups) {
    segments merged;
    merged.assign(labels_of_groups(n, groups));
    return merged;
}

}  // namespace gnomon::detail
