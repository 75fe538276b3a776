// SPDX-License-Identifier: BSL-1.0
/// @file
/// What both forms of Alg. 4.3 need: which segments to compare, and segments of merged ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The pairs of each of some points with its k nearest ones. O(m log m) for m points.
/// (A template, so that only its users compile a search.)
/// @param number  what to call each point in the pairs
void append_nearest_pairs(auto& pairs, const auto& points, std::size_t k, const auto& number) {
    const spatial_index index(points);
    scratch<neighbor> nearest;
    for (std::size_t f = 0; f < points.size(); ++f) {
        knn{.k = k}.find(index, f, nearest);
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

/// The segments of which those of a set of a `union_find` are one, largest first.
/// (A template, so that only its users compile a sort.)
/// @param result  may be `parts`
void unite_segments(segments& result, const segments& parts, auto& sets) {
    scratch<std::int32_t> labels(parts.labels().begin(), parts.labels().end());
    for (std::int32_t& label : labels)
        if (label != unlabeled)
            label = static_cast<std::int32_t>(sets.find(static_cast<point_index>(label)));
    number_by_size(labels);
    result.assign(labels);
}

}  // namespace gnomon::detail
