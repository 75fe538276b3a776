// SPDX-License-Identifier: BSL-1.0
/// @file
/// The rounds of merge_occluded: which pairs of segments are compared, which gaps are closed, and
/// which segments become one.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/fragment.hpp>
#include <gnomon/occlusion/detail/gap_verdict.hpp>
#include <gnomon/occlusion/detail/plane_comparison.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon::detail {

/// A gap between two segments, as `considered_gap`.
struct examined_gap {
    scratch<boundary_pair> lines;
    observation_count seen = {};
    bool merged = false;
};

/// One run of the algorithm.
/// @tparam Points   a position_view
/// @tparam Options  `merge_occluded_options`, which are valid
template <class Points, class Normals, merge_policy M, class Options, execution X>
class occlusion_merger {
  public:
    /// @param known  fragments of an earlier run over the same points, with the same options: those
    ///               with the same members as a segment are not computed again
    occlusion_merger(const Points& points, const viewpoint_table& viewpoints,
                     const Normals& normals, const segments& parts, const visibility& visible,
                     const M& policy, const Options& options, const X& run,
                     scratch<fragment>& known)
        : points_(points),
          viewpoints_(viewpoints),
          normals_(normals),
          visible_(visible),
          policy_(policy),
          options_(options),
          positions_(points.size()) {
        constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
        scratch<std::size_t> known_of(parts.size(), none);
        for (std::size_t f = 0; f < known.size(); ++f) {
            const std::int32_t label = parts.labels()[known[f].members.front()];
            if (label == unlabeled) continue;
            const auto s = static_cast<std::size_t>(label);
            // (Not by std::ranges::equal, whose concepts all users would compile.)
            const auto& before = known[f].members;
            const auto now = parts[s];
            if (std::equal(before.begin(), before.end(), now.begin(), now.end())) known_of[s] = f;
        }
        scratch<std::size_t> begin(parts.size(), 0);
        for (std::size_t s = 1; s < parts.size(); ++s)
            begin[s] = begin[s - 1] + parts[s - 1].size();
        scratch<fragment> all(parts.size());
        run(parts.size(), [&](std::size_t s) {
            if (parts[s].empty()) return;
            const bool is_known = known_of[s] != none;
            all[s] = is_known ? std::move(known[known_of[s]])
                              : fragment_with({parts[s].begin(), parts[s].end()}, begin[s]);
            all[s].is_new = true;
        });
        for (fragment& f : all)
            if (!f.members.empty()) fragments_.push_back(std::move(f));
    }

    /// Merges, round by round.
    void operator()() {
        while (merge_once()) {
        }
    }

    /// The labels of the points.
    [[nodiscard]] scratch<std::int32_t> labels() const {
        return labels_of_groups(points_.size(), fragments_, &fragment::members);
    }
    /// All gaps that were examined, in the order of the rounds.
    [[nodiscard]] std::span<const examined_gap> gaps() const { return gaps_; }
    /// The fragments after merging, for another run.
    [[nodiscard]] scratch<fragment> take_fragments() { return std::move(fragments_); }

  private:
    /// @param begin  of its positions in `positions_`
    [[nodiscard]] fragment fragment_with(scratch<point_index> members, std::size_t begin) {
        const auto positions = std::span(positions_).subspan(begin, members.size());
        return fragment_of(points_, normals_, viewpoints_, std::move(members), positions,
                           options_.max_variation, options_.max_angle, options_.sigma);
    }

    /// A gap that may be closed.
    struct link {
        point_index first, second;  ///< the fragments on both sides
        double offset;              ///< of one from the plane of the other [m]
        std::size_t gap;            ///< its number
    };

    /// One round.
    /// @return whether it merged any
    bool merge_once() {
        scratch<link> links;
        for (const auto& [i, j] : pairs_to_compare(fragments_, options_.candidates,
                                                   &fragment::is_flat, &fragment::frame)) {
            const fragment &a = fragments_[i], &b = fragments_[j];
            if (!a.is_new && !b.is_new) continue;
            const plane_comparison planes = comparison_of(a, b, options_.sigma);
            if (!planes.is_of_one(options_.max_angle, options_.max_offset)) continue;
            examined_gap gap;
            gap.lines.reserve(options_.boundary_pairs);
            append_boundary_pairs(gap.lines, points_, a.on_plane, b.on_plane,
                                  {a.frame.centroid, b.frame.centroid}, options_.boundary_pairs);
            if (is_closed(gap, may_adjoin(a, b)))
                links.push_back({i, j, planes.offset(), gaps_.size()});
            gaps_.push_back(std::move(gap));
        }
        if (links.empty()) return false;
        union_find sets = sets_of(links);
        for (const link& l : links) gaps_[l.gap].merged = sets.find(l.first) == sets.find(l.second);
        gather(sets);
        return true;
    }

    /// What the links join, the closest planes first. A fragment that tells little of its plane may
    /// be of one with two that are certainly of two: it does not join these, each set being judged
    /// by its largest fragment.
    [[nodiscard]] union_find sets_of(scratch<link>& links) const {
        std::sort(links.begin(), links.end(), [this](const link& a, const link& b) {
            if (a.offset != b.offset) return a.offset < b.offset;
            return coplanar_distance(gaps_[a.gap].lines) < coplanar_distance(gaps_[b.gap].lines);
        });
        union_find sets(fragments_.size());
        scratch<point_index> largest(fragments_.size());
        std::iota(largest.begin(), largest.end(), point_index{0});
        for (const link& l : links) {
            const point_index a = largest[sets.find(l.first)], b = largest[sets.find(l.second)];
            if (comparison_of(fragments_[a], fragments_[b], options_.sigma)
                    .is_of_two(options_.max_angle, options_.max_offset))
                continue;
            const bool first = fragments_[a].members.size() >= fragments_[b].members.size();
            largest[sets.unite(l.first, l.second)] = first ? a : b;
        }
        return sets;
    }

    /// Whether the policy accepts most of the lines across a gap, or, if the gap is narrow and its
    /// sides may adjoin, whether `liberal` does.
    /// @param gap  stores what was seen in it
    [[nodiscard]] bool is_closed(examined_gap& gap, bool may_adjoin) const {
        std::size_t accepted = 0, passable = 0;
        bool is_kept_open = false;
        for (const boundary_pair& line : gap.lines) {
            const Eigen::Vector3d v =
                combined(0.5, viewpoints_[line.first], 0.5, viewpoints_[line.second]);
            const observation_count seen =
                visible_.between(points_[line.first], points_[line.second], v);
            gap.seen += seen;
            is_kept_open = is_kept_open || keeps_open(policy_, seen);
            accepted += accepts(policy_, seen) ? 1 : 0;
            passable += accepts(liberal{}, seen) ? 1 : 0;
        }
        return !is_kept_open && (2 * accepted > gap.lines.size() ||
                                 (may_adjoin && coplanar_distance(gap.lines) < options_.max_gap &&
                                  2 * passable > gap.lines.size()));
    }

    /// Makes one segment of each set.
    void gather(union_find& sets) {
        for (fragment& f : fragments_) f.is_new = false;
        for (std::size_t i = 0; i < fragments_.size(); ++i) {
            const point_index root = sets.find(static_cast<point_index>(i));
            if (root == i) continue;
            auto &from = fragments_[i].members, &to = fragments_[root].members;
            to.insert(to.end(), from.begin(), from.end());
            from.clear();
            fragments_[root].is_new = true;
        }
        std::erase_if(fragments_, [](const fragment& f) { return f.members.empty(); });
        for (fragment& f : fragments_) {
            if (!f.is_new) continue;
            std::sort(f.members.begin(), f.members.end());
            f = fragment_with(std::move(f.members), 0);
        }
    }

    const Points& points_;
    const viewpoint_table& viewpoints_;
    const Normals& normals_;
    const visibility& visible_;
    const M& policy_;
    const Options& options_;
    // One array for all threads: the memory in use does not depend on which segments are fitted at
    // the same time.
    scratch<Eigen::Vector3d> positions_;
    scratch<fragment> fragments_;
    scratch<examined_gap> gaps_;
};

}  // namespace gnomon::detail
