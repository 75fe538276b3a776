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

struct any_pair {
    bool operator()(point_index, point_index) const { return true; }
};

/// Each flat one of `parts` segments with those `wanted` possible ones whose centroids are nearest,
/// by their numbers, ascending and each pair once. The 300 nearest ones are looked at. O(m log m)
/// for m segments. (A template, so that only its users compile a search.)
/// @param is_flat      is_flat(s): whether segment s is
/// @param centroid_of  centroid_of(s) [m]
/// @param is_possible  is_possible(s, t): whether two flat ones may be a pair
template <class Possible = any_pair>
[[nodiscard]] scratch<region_pair> pairs_to_compare(std::size_t parts, std::size_t wanted,
                                                    auto&& is_flat, auto&& centroid_of,
                                                    const Possible& is_possible = {}) {
    scratch<point_index> flat;
    scratch<Eigen::Vector3d> centroids;
    for (std::size_t s = 0; s < parts; ++s) {
        if (!is_flat(s)) continue;
        flat.push_back(static_cast<point_index>(s));
        centroids.push_back(centroid_of(s));
    }
    constexpr std::size_t most = 300;  // performance only: almost all that a scan has
    scratch<region_pair> pairs;
    scratch<neighbor> nearest;  // by their numbers among the flat ones
    const auto add_nearest = [&](std::size_t f) {
        std::size_t found = 0;
        for (auto n = nearest.begin(); n != nearest.end() && found < wanted; ++n) {
            const region_pair pair = std::minmax(flat[f], flat[n->index]);
            if (!is_possible(pair.first, pair.second)) continue;
            pairs.push_back(pair);
            ++found;
        }
        return found;
    };
    if (flat.size() <= most) {
        for (std::size_t f = 0; f < flat.size(); ++f) {
            nearest.clear();
            for (std::size_t g = 0; g < flat.size(); ++g)
                if (g != f)
                    nearest.push_back({squared_distance(centroids[f], centroids[g]),
                                       static_cast<point_index>(g)});
            std::sort(nearest.begin(), nearest.end());
            add_nearest(f);
        }
    } else {
        const spatial_index index(centroids);
        for (std::size_t f = 0; f < flat.size(); ++f) {
            const std::size_t before = pairs.size();
            knn{.k = wanted}.find(index, f, nearest);
            if (add_nearest(f) >= std::min(wanted, flat.size() - 1)) continue;
            pairs.resize(before);
            knn{.k = std::max(wanted, most)}.find(index, f, nearest);
            add_nearest(f);
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
