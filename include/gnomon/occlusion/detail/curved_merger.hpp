// SPDX-License-Identifier: BSL-1.0
/// @file
/// Merging of curved surfaces across gaps: a road before a vehicle and behind it, or on both sides
/// of the place below a lidar that the lidar cannot see. As merge_occluded for planes, with
/// paraboloids.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/detail/examined_gap.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/detail/curved_pieces.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_fit.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/detail/surface_patch.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// One run: the most similar pair first, of which one is curved, until no two are similar.
template <merge_policy M>
class curved_merger {
  public:
    /// @param cloud    of the points
    /// @param parts    segments of these points: planes
    /// @param planes   the sets of coplanar segments that were merged
    /// @param curved   the sets of segments that are pieces of one curved surface
    curved_merger(const spatial_index& points, const planar_cloud& cloud, const segments& parts,
                  union_find& planes, union_find& curved, const visibility& visible,
                  const M& policy, const merge_occluded_options& options)
        : points_(points),
          visible_(visible),
          policy_(policy),
          options_(options),
          sets_(parts.size()),
          patches_(parts.size()),
          members_(parts.size()) {
        sets_.unite_as(planes);
        sets_.unite_as(curved);
        scratch<std::int32_t> labels(parts.labels().begin(), parts.labels().end());
        unite_labels(labels, planes);
        const label_groups regions(labels);
        for (std::size_t r = 0; r < regions.size(); ++r) add(r, regions[r], cloud);
    }

    /// Merges the segments; their sets.
    /// @param each_gap  each_gap(examined_gap) is called for all gaps
    [[nodiscard]] union_find operator()(auto&& each_gap) {
        scratch<candidate> candidates = all_candidates();
        while (!candidates.empty()) {
            const auto best = std::min_element(candidates.begin(), candidates.end());
            const point_index a = best->second.first, b = best->second.second;
            candidates.erase(best);
            examined_gap gap = gap_between({a, members_[a]}, {b, members_[b]}, points_, visible_,
                                           policy_, options_);
            gap.merged = gap.is_closed;
            each_gap(gap);
            if (!gap.merged) continue;
            sets_.unite(a, b);
            patches_[a].add(patches_[b]);
            members_[a].insert(members_[a].end(), members_[b].begin(), members_[b].end());
            patches_[b] = {};
            std::erase_if(candidates, [&](const candidate& c) {
                const region_pair& p = c.second;
                return p.first == a || p.first == b || p.second == a || p.second == b;
            });
            for (std::size_t other = 0; other < patches_.size(); ++other)
                if (other != a)
                    compare(std::minmax(a, static_cast<point_index>(other)), candidates);
        }
        return std::move(sets_);
    }

  private:
    using candidate = std::pair<double, region_pair>;  // dissimilarity

    /// Adds a region to the patch of its set, if it is planar.
    void add(std::size_t region, std::span<const point_index> points, const planar_cloud& cloud) {
        const planar_region plane = region_of(cloud, points);
        if (!plane.is_planar) return;
        scratch<point_index> on;
        for (const point_index i : points)
            if (cloud.is_finite(i) && cloud.is_on(i, plane.fit)) on.push_back(i);
        const point_index set = sets_.find(static_cast<point_index>(region));
        patches_[set].add(patch_of(cloud, plane, on));
        members_[set].insert(members_[set].end(), on.begin(), on.end());
    }

    [[nodiscard]] scratch<candidate> all_candidates() const {
        scratch<candidate> candidates;
        for (point_index a = 0; a < patches_.size(); ++a)
            for (point_index b = a + 1; b < patches_.size(); ++b) compare({a, b}, candidates);
        return candidates;
    }

    /// Adds a pair to the candidates if it may be merged.
    void compare(const region_pair& pair, scratch<candidate>& candidates) const {
        const double d = dissimilarity_of_curved(patches_[pair.first], patches_[pair.second],
                                                 options_.max_offset);
        if (d <= 1.0) candidates.emplace_back(d, pair);
    }

    const spatial_index& points_;
    const visibility& visible_;
    const M& policy_;
    const merge_occluded_options& options_;
    union_find sets_;
    scratch<surface_patch> patches_;         // of the sets, at their smallest segments
    scratch<scratch<point_index>> members_;  // likewise, those on the planes
};

/// The sets of the segments of an index that are one surface, plane or curved, after merging.
/// @param cloud     of the points
/// @param curved    the sets of segments that are pieces of one curved surface
/// @param each_gap  each_gap(examined_gap) is called for all gaps
template <merge_policy M, execution X>
[[nodiscard]] union_find merged_surfaces(const spatial_index& points, const planar_cloud& cloud,
                                         const segments& parts, union_find curved,
                                         const visibility& visible, const M& policy,
                                         const merge_occluded_options& options, const X& run,
                                         auto&& each_gap) {
    union_find planes = merged_sets(points, cloud, parts, visible, policy, options, run, each_gap);
    if (curved.is_of_singletons()) return planes;
    return curved_merger(points, cloud, parts, planes, curved, visible, policy, options)(each_gap);
}

}  // namespace gnomon::detail
