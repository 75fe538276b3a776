// SPDX-License-Identifier: BSL-1.0
/// @file
/// What both forms of Alg. 4.3 need: which segments to compare, and segments of merged ones.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/neighbor.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// Each flat one of `parts` segments with those `wanted` flat ones whose centroids are nearest, by
/// their numbers, ascending and each pair once. O(m log m) for m segments, or O(m^2) where all are
/// wanted. (A template, so that only its users compile a search.)
/// @param is_flat      is_flat(s): whether segment s is
/// @param centroid_of  centroid_of(s) [m]
[[nodiscard]] scratch<region_pair> pairs_to_compare(std::size_t parts, std::size_t wanted,
                                                    auto&& is_flat, auto&& centroid_of) {
    scratch<point_index> flat;
    scratch<Eigen::Vector3d> centroids;
    for (std::size_t s = 0; s < parts; ++s) {
        if (!is_flat(s)) continue;
        flat.push_back(static_cast<point_index>(s));
        centroids.push_back(centroid_of(s));
    }
    scratch<region_pair> pairs;
    if (flat.size() <= wanted) {
        for (std::size_t f = 0; f < flat.size(); ++f)
            for (std::size_t g = f + 1; g < flat.size(); ++g) pairs.emplace_back(flat[f], flat[g]);
        return pairs;
    }
    constexpr std::size_t few = 300;  // performance only: for more a tree is faster than sorting
    if (flat.size() > few) {
        const spatial_index index(centroids);
        scratch<neighbor> nearest;
        for (std::size_t f = 0; f < flat.size(); ++f) {
            knn{.k = wanted}.find(index, f, nearest);
            for (const neighbor& n : nearest) pairs.push_back(std::minmax(flat[f], flat[n.index]));
        }
    } else {
        scratch<std::pair<double, point_index>> others;
        for (std::size_t f = 0; f < flat.size(); ++f) {
            others.clear();
            for (std::size_t g = 0; g < flat.size(); ++g)
                if (g != f)
                    others.emplace_back(squared_distance(centroids[f], centroids[g]), flat[g]);
            std::sort(others.begin(), others.end());
            for (std::size_t o = 0; o < wanted; ++o)
                pairs.push_back(std::minmax(flat[f], others[o].second));
        }
    }
    make_unique(pairs);
    return pairs;
}

/// The segments after uniting those in the same set, largest first.
/// (A template, so that only its users compile a sort.)
[[nodiscard]] segments united_segments(const segments& parts, auto& sets) {
    std::vector<std::int32_t> labels = parts.labels();
    unite_labels(labels, sets);
    return numbered_segments_of(std::move(labels));
}

}  // namespace gnomon::detail
