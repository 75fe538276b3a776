// SPDX-License-Identifier: BSL-1.0
/// @file
/// A labeling of a cloud by planes: their growth, the merging of neighbors, the competition for
/// points, and cuts at edges, in turns; at last their parts that are apart are separated.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/neighborhood.hpp>
#include <gnomon/segmentation/detail/agglomeration.hpp>
#include <gnomon/segmentation/detail/crease_cut.hpp>
#include <gnomon/segmentation/detail/edge_cut.hpp>
#include <gnomon/segmentation/detail/label_competition.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/detail/plane_comparison.hpp>
#include <gnomon/segmentation/detail/plane_growth.hpp>
#include <gnomon/segmentation/detail/plane_sums.hpp>
#include <gnomon/segmentation/detail/region_edges.hpp>
#include <gnomon/segmentation/detail/region_labels.hpp>
#include <gnomon/segmentation/detail/region_pairs.hpp>
#include <gnomon/segmentation/detail/separate_parts.hpp>
#include <gnomon/segmentation/detail/step_cut.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// The regions of a cloud.
template <neighborhood_graph G, neighborhood_graph Near>
class plane_regions {
  public:
    /// @param graph  the neighbors of each point that a region may grow to
    /// @param near   the neighbors whose labels compete for it; another graph, or the same
    plane_regions(const planar_cloud& cloud, const G& graph, const Near& nearby,
                  std::size_t min_points)
        : cloud_(cloud),
          graph_(graph),
          near_(nearby),
          min_points_(min_points),
          labels_(cloud.size(), unlabeled) {}

    [[nodiscard]] const scratch<std::int32_t>& labels() const { return labels_; }
    [[nodiscard]] const scratch<planar_region>& regions() const { return regions_; }

    /// The edges between the regions, if creases were cut.
    template <execution X>
    [[nodiscard]] region_edges<> edges(const X& run) const {
        if (!keeps_creases_) return {};
        return {cloud_, regions_, labels_,
                touching_regions(near_, labels_, borders_of(near_, labels_, run), run)};
    }

    /// Grows new regions in what is unlabeled, and settles them.
    template <normal_range S, execution X>
    void grow(const S& surface, double min_cosine, const X& run) {
        plane_growth(cloud_, graph_, surface, min_points_, min_cosine, labels_)(
            static_cast<std::int32_t>(regions_.size()), run);
        settle_again(run);
    }

    /// Cuts regions at edges, and settles them.
    template <execution X>
    void cut_edges(const X& run) {
        cut(run, [this](std::span<const point_index> members, const planar_region& whole) {
            return sides_of(
                members,
                edge_cut(
                    cloud_, members, whole, min_points_,
                    [](const auto& a, const auto& b) { return are_at_edge(a, b); }, false));
        });
    }

    /// Cuts regions at creases and steps, and moves the borders between regions to creases, in at
    /// most `most_rounds` rounds: between two, the competition gives single points near a crease to
    /// the other side again. From now on creases and steps keep regions apart.
    template <execution X>
    void cut_creases(const X& run) {
        keeps_creases_ = true;
        const auto cut_of = [this](std::span<const point_index> members,
                                   const planar_region& whole) {
            const auto at_crease = edge_cut(
                cloud_, members, whole, min_points_,
                [](const auto& a, const auto& b) { return are_at_crease(a, b); }, true);
            return at_crease ? sides_of(members, at_crease)
                             : step_cut(cloud_, members, whole, min_points_);
        };
        for (int round = 0; round < most_rounds; ++round) {
            const bool has_cut = cut(run, cut_of);
            if (!move_to_creases(run) && !has_cut) return;
        }
    }

    /// Makes regions of the parts of regions that no neighbors connect.
    template <execution X>
    void separate(const X& run) {
        if (!separate_parts(graph_, labels_, min_points_, run)) return;
        refit();
        number_regions(labels_, regions_);
    }

  private:
    /// On which side of a cut the members of a region are, 0 or 1 each; none if there is no cut.
    [[nodiscard]] scratch<std::int32_t> sides_of(std::span<const point_index> members,
                                                 const std::optional<plane>& cut) const {
        scratch<std::int32_t> sides;
        if (!cut) return sides;
        for (const point_index i : members)
            sides.push_back(cut->signed_distance(cloud_.offsets[i]) > 0.0 ? 1 : 0);
        return sides;
    }

    /// Cuts regions where several planes explain them better, and settles them. (Label is a
    /// parameter so that only its users compile arrays of arrays.)
    /// @param cut_of  cut_of(members, region): the numbers of the parts that they are of, or none;
    ///                all but 0 become regions of their own
    /// @return whether a region was cut
    template <execution X, class Label = std::int32_t>
    bool cut(const X& run, auto&& cut_of) {
        const label_groups members(labels_);
        scratch<scratch<Label>> parts(members.size());
        run(members.size(), [&](std::size_t r) { parts[r] = cut_of(members[r], regions_[r]); });
        auto next = static_cast<std::int32_t>(regions_.size());
        const std::int32_t first = next;
        for (std::size_t r = 0; r < members.size(); ++r) {
            std::int32_t last = 0;
            for (std::size_t m = 0; m < parts[r].size(); ++m) {
                const std::int32_t part = parts[r][m];
                if (part > 0) labels_[members[r][m]] = next + part - 1;
                last = std::max(last, part);
            }
            next += last;
        }
        if (next == first) return false;
        settle_again(run);
        return true;
    }

    /// Moves the borders between regions to the creases at which they meet, and settles them. A
    /// region is in one pair at a time, the first of them.
    /// @return whether a point has moved
    template <execution X>
    bool move_to_creases(const X& run) {
        const auto pairs = touching_regions(near_, labels_, borders_of(near_, labels_, run), run);
        const label_groups parts(labels_);
        scratch<char> has_changed(regions_.size(), false);
        bool any = false;
        for (const auto& [a, b] : pairs) {
            if (has_changed[a] != 0 || has_changed[b] != 0) continue;
            const auto cut = crease_cut(cloud_, parts, regions_, a, b, min_points_);
            if (!cut) continue;
            for (const point_index r : {a, b}) {
                for (const point_index i : parts[r]) {
                    const bool is_of_b = cut->signed_distance(cloud_.offsets[i]) > 0.0;
                    const auto to = static_cast<std::int32_t>(is_of_b ? b : a);
                    if (labels_[i] != to) has_changed[a] = has_changed[b] = any = true;
                    labels_[i] = to;
                }
            }
        }
        if (!any) return false;
        settle_again(run);
        return true;
    }

    template <execution X>
    void settle_again(const X& run) {
        refit();
        settle(run);
        number_regions(labels_, regions_);
    }

    /// Merges regions next to each other that one plane explains. Then, in at most `most_rounds`
    /// rounds, each point goes to the region, among those of its neighbors and its own, that
    /// explains it best, or to none if all are too far, and regions are merged again.
    template <execution X>
    void settle(const X& run) {
        scratch<char> is_border = borders_of(near_, labels_, run);
        const auto touching = [&] { return touching_regions(near_, labels_, is_border, run); };
        merge(touching());
        for (int round = 0; round < most_rounds; ++round) {
            region_edges<> edges;
            if (keeps_creases_) edges = region_edges<>(cloud_, regions_, labels_, touching());
            auto after = compete(cloud_, near_, regions_, edges, labels_, is_border, run);
            const bool rests = labels_ == after;
            labels_.swap(after);
            refit();
            if (!merge(touching()) && rests) break;
        }
    }

    /// Merges regions that one plane explains.
    /// @param pairs  those next to each other
    /// @return whether there were any
    bool merge(scratch<region_pair> pairs) {
        std::erase_if(pairs, [this](const region_pair& p) {
            return regions_[p.first].is_empty() || regions_[p.second].is_empty();
        });
        union_find sets = agglomeration(regions_)(
            std::move(pairs),
            [this](const planar_region& a, const planar_region& b) {
                return keeps_creases_ && are_at_crease_or_step(a, b)
                           ? std::numeric_limits<double>::infinity()
                           : dissimilarity_of_neighbors(a, b);
            },
            [](point_index, point_index) { return true; },
            [](union_find&) { return scratch<region_pair>(); });
        bool any = false;
        for (std::size_t r = 0; r < regions_.size(); ++r) {
            if (sets.find(static_cast<point_index>(r)) == r) continue;
            regions_[r] = {};
            any = true;
        }
        unite_labels(labels_, sets);
        return any;
    }

    void refit() { fit_regions(cloud_, min_points_, labels_, regions_); }

    const planar_cloud& cloud_;
    const G& graph_;
    const Near& near_;
    std::size_t min_points_;
    bool keeps_creases_ = false;
    scratch<std::int32_t> labels_;
    scratch<planar_region> regions_;
};

}  // namespace gnomon::detail
