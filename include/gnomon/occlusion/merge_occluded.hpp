// SPDX-License-Identifier: BSL-1.0
/// @file
/// Mends surfaces that something in front has torn: flat segments in one plane are merged where
/// what was seen in the gap between them speaks for it.
///
/// Klasing 2010, Sec. 4.3, Alg. 4.3, in a form that depends on no order: in rounds, each of which
/// judges all pairs with a new segment and merges those that are accepted, until none is; but what
/// is certainly of two planes is not joined by way of a third segment that may be of both. A narrow
/// gap, which the thesis closes whatever is seen in it, stays open where something farther is
/// (specification of it, A15 to A19); and whether two segments are in one plane is asked of their
/// ranges, as far as noise lets them tell, and, of what adjoins, of its normals.
/// merge_occluded_literally is the algorithm to the letter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/fragment.hpp>
#include <gnomon/occlusion/detail/gap_verdict.hpp>
#include <gnomon/occlusion/detail/plane_comparison.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of Alg. 4.3, with the thesis's values (Sec. 4.4.1).
struct occlusion_merging {
    double max_variation = 0.15;    ///< sigma_sv,max of a flat segment: 0 a plane, 1/3 a ball
    angle max_angle = degrees(15);  ///< rho_a between coplanar segments
    double max_offset = 0.05;       ///< rho_o of coplanar segments [m]
    /// rho_c [m]: no limit, but narrower gaps are closed whatever the policy says, unless they are
    /// seen through, or their sides are too slim to tell that they go on in one another.
    double max_gap = 0.20;
    /// Standard deviation of ranges [m], greater than 0; of points across a surface it is no more.
    /// What is less flat, or less in one plane, than the thresholds want may be so by noise, and
    /// what keeps to them by less than noise would.
    double sigma = 0.015;
    std::size_t boundary_pairs = 6;  ///< n_b, an even number
    /// k_c, the segments with nearest centroids that each is compared with; 0 stands for all of up
    /// to 300 segments, and for 20 of more. Two that become neighbors only because others merged
    /// are not compared in the same run.
    std::size_t candidates = 0;
};

/// The gap between two segments whose merging was considered, and what became of it.
struct considered_gap {
    std::vector<boundary_pair> lines;
    sighting_count seen;  ///< along all of them
    bool merged;
};

/// Segments after merging, and every gap that was looked into, in the order of the rounds.
struct merged_segments {
    gnomon::segments segments;
    std::vector<considered_gap> gaps;
};

namespace detail {

/// Refuses what no form of the algorithm can work with.
inline void require_thresholds(const occlusion_merging& options) {
    require(options.boundary_pairs > 0 && options.boundary_pairs % 2 == 0,
            "occlusion_merging: the number of boundary pairs must be even and not 0");
    require(options.max_variation >= 0.0 && options.max_offset >= 0.0 && options.max_gap >= 0.0 &&
                options.max_angle.radians() >= 0.0,
            "occlusion_merging: a threshold is negative or NaN");
}

/// Normals of points of which none has one.
struct no_normals {
    struct element {
        Eigen::Vector3d normal{0.0, 0.0, 0.0};
    };
    [[nodiscard]] element operator[](std::size_t) const { return {}; }
};

/// One run of the algorithm.
template <class R, class Normals, merge_policy M, class Proj>
class occlusion_merger {
  public:
    occlusion_merger(const R& points, const Normals& normals, const segments& parts,
                     const lines_of_sight& sights, const M& policy,
                     const occlusion_merging& options, Proj projection)
        : range_(points),
          projection_(std::move(projection)),
          points_(points, projection_),
          normals_(normals),
          sights_(sights),
          viewpoints_(viewpoints_of(points)),
          policy_(policy),
          options_(options) {
        require(parts.labels().size() == points_.size(),
                "merge_occluded: the segments are of other points");
        require_thresholds(options);
        require(options.sigma > 0.0 && std::isfinite(options.sigma),
                "merge_occluded: sigma must be greater than 0, and finite");
        for (std::size_t s = 0; s < parts.size(); ++s)
            if (!parts[s].empty())
                fragments_.push_back(fragment_with({parts[s].begin(), parts[s].end()}));
    }

    [[nodiscard]] merged_segments operator()() {
        while (merge_once()) {
        }
        return {segments_of_groups(points_.size(), fragments_, &fragment::members),
                std::move(gaps_)};
    }

  private:
    [[nodiscard]] fragment fragment_with(std::vector<point_index> members) const {
        return fragment_of(range_, projection_, normals_, viewpoints_, std::move(members),
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
        std::vector<link> links;
        for (const auto& [i, j] : pairs_to_compare(fragments_, options_.candidates,
                                                   &fragment::is_flat, &fragment::frame)) {
            const fragment &a = fragments_[i], &b = fragments_[j];
            if (!a.is_new && !b.is_new) continue;
            const plane_comparison planes = comparison_of(a, b, options_.sigma);
            if (!planes.is_of_one(options_.max_angle, options_.max_offset)) continue;
            considered_gap gap{
                boundary_pairs(points_, a.on_plane, b.on_plane,
                               {a.frame.centroid, b.frame.centroid}, options_.boundary_pairs),
                {},
                false};
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
    [[nodiscard]] union_find sets_of(std::vector<link>& links) const {
        std::sort(links.begin(), links.end(), [this](const link& a, const link& b) {
            if (a.offset != b.offset) return a.offset < b.offset;
            return coplanar_distance(gaps_[a.gap].lines) < coplanar_distance(gaps_[b.gap].lines);
        });
        union_find sets(fragments_.size());
        std::vector<point_index> largest(fragments_.size());
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

    /// Whether most of the lines across a gap are accepted by the policy, or, where it is narrow
    /// and its sides may adjoin, by whoever merges unless something farther is seen.
    /// @param gap  learns what was seen in it
    [[nodiscard]] bool is_closed(considered_gap& gap, bool may_adjoin) const {
        std::size_t accepted = 0, passable = 0;
        bool is_kept_open = false;
        for (const boundary_pair& line : gap.lines) {
            const Eigen::Vector3d v =
                detail::combined(0.5, viewpoints_[line.first], 0.5, viewpoints_[line.second]);
            const sighting_count seen =
                sights_.between(points_[line.first], points_[line.second], v);
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
            f = fragment_with(std::move(f.members));
        }
    }

    const R& range_;
    Proj projection_;
    position_view<R, Proj> points_;
    const Normals& normals_;
    const lines_of_sight& sights_;
    viewpoint_table viewpoints_;
    const M& policy_;
    const occlusion_merging& options_;
    std::vector<fragment> fragments_;
    std::vector<considered_gap> gaps_;
};

}  // namespace detail

/// Merges flat segments that are one surface behind something.
///
/// @param points   any point range of n points; their view points as in `lines_of_sight`
/// @param surface  their n surface elements, or anything with normals towards the view points; what
///                 has none is judged without
/// @param parts    segments of these points
/// @param sights   what was seen from where, best by the whole cloud
/// @param policy   `conservative`, `liberal` or another
/// @throws std::invalid_argument  if the surface or the segments are of another number of points,
///                                for an odd or no number of boundary pairs, a negative or NaN
///                                threshold, or a sigma that is not finite and
///                                greater than 0
/// Complexity: per round O(candidates * (n + pixels of the gaps * view points)); rounds are few.
template <class R, normal_range Surface, merge_policy M = conservative, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const Surface& surface,
                                             const segments& parts, const lines_of_sight& sights,
                                             const M& policy = {},
                                             const occlusion_merging& options = {},
                                             Proj projection = {}) {
    detail::require(std::ranges::size(surface) == parts.labels().size(),
                    "merge_occluded: the surface is of other points");
    return detail::occlusion_merger(points, surface, parts, sights, policy, options,
                                    std::move(projection))();
}

/// The same where normals are not at hand: of what is slim more that only adjoins is merged.
template <class R, merge_policy M = conservative, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const segments& parts,
                                             const lines_of_sight& sights, const M& policy = {},
                                             const occlusion_merging& options = {},
                                             Proj projection = {}) {
    return detail::occlusion_merger(points, detail::no_normals{}, parts, sights, policy, options,
                                    std::move(projection))();
}

}  // namespace gnomon
