// SPDX-License-Identifier: BSL-1.0
/// @file
/// Agglomerative merging of regions: the most similar pair first, as long as one plane explains all
/// points of the union (after Feng et al. 2014).
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>

namespace gnomon::detail {

/// Merges regions in rounds, the most similar pair first, until a round merges none. Within a round
/// a pair is compared again if one of its regions has grown; the pair is merged if its
/// dissimilarity is still at most 1. (A template, so that only its users compile it.)
template <class Region>
class agglomeration {
  public:
    /// @param regions  their sums and planes; those of the root of a set stand for it afterwards
    explicit agglomeration(scratch<Region>& regions)
        : regions_(regions), sets_(regions.size()), is_new_(regions.size(), true) {}

    /// @param pairs          to be compared, each once
    /// @param dissimilarity  dissimilarity(region, region); pairs up to 1 are merged
    /// @param accepts        accepts(a, b): last condition, called with the regions as they were
    ///                       when the round began
    /// @param renew          renew(sets), after each round that merged any: the pairs of regions
    ///                       that are to be compared as well; it may fit the regions again that
    ///                       have grown
    /// @return the sets of merged regions
    [[nodiscard]] union_find operator()(scratch<region_pair> pairs, auto&& dissimilarity,
                                        auto&& accepts, auto&& renew) {
        std::size_t known = 0;
        while (!pairs.empty() && merge_once(pairs, known, dissimilarity, accepts)) {
            const scratch<region_pair> more = renew(sets_);
            for (auto& [a, b] : pairs) {
                const point_index root_of_a = sets_.find(a), root_of_b = sets_.find(b);
                a = std::min(root_of_a, root_of_b);
                b = std::max(root_of_a, root_of_b);
            }
            std::erase_if(pairs, [](const region_pair& p) { return p.first == p.second; });
            make_unique(pairs);
            known = pairs.size();
            for (const region_pair& p : more) {
                const auto end = pairs.begin() + static_cast<std::ptrdiff_t>(known);
                if (!std::binary_search(pairs.begin(), end, p)) pairs.push_back(p);
            }
        }
        return std::move(sets_);
    }

  private:
    struct candidate {
        double dissimilarity;
        region_pair pair;
        [[nodiscard]] bool operator<(const candidate& o) const {
            return dissimilarity != o.dissimilarity ? dissimilarity < o.dissimilarity
                                                    : pair < o.pair;
        }
    };

    /// One round.
    /// @param known  the number of pairs, the first ones, that were in the rounds before
    /// @return whether it merged any
    bool merge_once(const scratch<region_pair>& pairs, std::size_t known, auto&& dissimilarity,
                    auto&& accepts) {
        scratch<candidate> candidates;
        for (std::size_t p = 0; p < pairs.size(); ++p) {
            const region_pair& pair = pairs[p];
            if (p < known && is_new_[pair.first] == 0 && is_new_[pair.second] == 0) continue;
            const double d = dissimilarity(regions_[pair.first], regions_[pair.second]);
            if (d <= 1.0) candidates.push_back({d, pair});
        }
        std::sort(candidates.begin(), candidates.end());
        std::fill(is_new_.begin(), is_new_.end(), false);
        bool any = false;
        for (const candidate& c : candidates) {
            const point_index a = sets_.find(c.pair.first), b = sets_.find(c.pair.second);
            if (a == b) continue;
            const bool has_changed = is_new_[a] != 0 || is_new_[b] != 0;
            if (has_changed && !(dissimilarity(regions_[a], regions_[b]) <= 1.0)) continue;
            if (!accepts(c.pair.first, c.pair.second)) continue;
            plane_sums sums = regions_[a].sums;
            sums.add(regions_[b].sums);
            const point_index whole = sets_.unite(a, b);
            regions_[whole] = {sums, sums.fit()};
            is_new_[whole] = any = true;
        }
        return any;
    }

    scratch<Region>& regions_;
    union_find sets_;
    scratch<char> is_new_;  // changed since the round before
};

}  // namespace gnomon::detail
