// SPDX-License-Identifier: BSL-1.0
/// @file
/// Agglomerative merging of regions: the most alike first, as long as one plane explains all that
/// become one (after Feng et al. 2014).
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>

namespace gnomon::detail {

using region_pair = std::pair<point_index, point_index>;

/// Sorts pairs, and leaves each once.
inline void make_unique(scratch<region_pair>& pairs) {
    std::sort(pairs.begin(), pairs.end());
    pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Merges regions in rounds, until no pair is alike: in each, pairs from the most alike on, if they
/// still are as what they have become.
/// @param regions  their sums and planes; those of the root of a set stand for it afterwards
/// @param pairs    that may be one, each once
/// @param unlike   unlike(region, region): at most 1 if they may be one
/// @param accepts  accepts(a, b): whether else these two may be one, as they were at the beginning
///                 of the round; called when all else is in favor
/// @param gather   gather(into, from), after each round, for all that have become part of another
/// @return the sets of regions that are one
[[nodiscard]] union_find agglomerated(scratch<planar_region>& regions, scratch<region_pair> pairs,
                                      auto&& unlike, auto&& accepts, auto&& gather) {
    struct candidate {
        double unlikeness;
        region_pair pair;
        [[nodiscard]] bool operator<(const candidate& o) const {
            return unlikeness != o.unlikeness ? unlikeness < o.unlikeness : pair < o.pair;
        }
    };
    union_find sets(regions.size());
    scratch<candidate> candidates;
    scratch<char> is_new(regions.size(), true), changed(regions.size(), false),
        is_root(regions.size(), true);
    while (!pairs.empty()) {
        candidates.clear();
        for (const auto& pair : pairs) {
            if (is_new[pair.first] == 0 && is_new[pair.second] == 0) continue;
            const double u = unlike(regions[pair.first], regions[pair.second]);
            if (u <= 1.0) candidates.push_back({u, pair});
        }
        std::sort(candidates.begin(), candidates.end());
        std::fill(changed.begin(), changed.end(), false);
        bool any = false;
        for (const candidate& c : candidates) {
            const point_index a = sets.find(c.pair.first), b = sets.find(c.pair.second);
            if (a == b) continue;
            if ((changed[a] != 0 || changed[b] != 0) && !(unlike(regions[a], regions[b]) <= 1.0))
                continue;
            if (!accepts(c.pair.first, c.pair.second)) continue;
            plane_sums sums = regions[a].sums;
            sums.add(regions[b].sums);
            planar_region& whole = regions[sets.unite(a, b)];
            whole = {sums, sums.fit()};
            changed[sets.find(a)] = any = true;
        }
        if (!any) break;
        for (std::size_t r = 0; r < sets.size(); ++r) {
            const auto region = static_cast<point_index>(r), root = sets.find(region);
            if (root != region && is_root[r] != 0) gather(root, region);
            is_root[r] = root == region;
        }
        is_new.swap(changed);
        for (region_pair& p : pairs) p = std::minmax({sets.find(p.first), sets.find(p.second)});
        std::erase_if(pairs, [](const region_pair& p) { return p.first == p.second; });
        make_unique(pairs);
    }
    return sets;
}

}  // namespace gnomon::detail
