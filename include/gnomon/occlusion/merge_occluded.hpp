// SPDX-License-Identifier: BSL-1.0
/// @file
/// Mends surfaces that something in front has torn: flat segments in one plane are merged where
/// what was seen in the gap between them speaks for it.
///
/// Klasing 2010, Sec. 4.3, Alg. 4.3, in a form that depends on no order: in rounds, each of which
/// judges all pairs of segments as they are and merges those that are accepted, until none is. A
/// narrow gap, which the thesis closes whatever is seen in it, stays open where something farther
/// is (specification of it, A15 to A19); and whether two segments are in one plane is asked of
/// their ranges, as far as noise lets them tell. merge_occluded_literally is the algorithm to the
/// letter.
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/seen_plane.hpp>
#include <gnomon/occlusion/detail/segment_groups.hpp>
#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of Alg. 4.3, with the thesis's values (Sec. 4.4.1).
struct occlusion_merging {
    double max_variation = 0.15;    ///< sigma_sv,max, surface variation of a flat segment
    angle max_angle = degrees(15);  ///< rho_a between coplanar segments
    double max_offset = 0.05;       ///< rho_o of coplanar segments [m]
    double max_gap = 0.20;          ///< rho_c [m]: narrower gaps only stay open if seen through
    /// Standard deviation of points across a surface [m], greater than 0. What is less flat, or
    /// less in one plane, than the thresholds want may be so by noise, and what keeps to them by
    /// less than noise would.
    double sigma = 0.015;
    std::size_t boundary_pairs = 6;  ///< n_b, an even number
    /// k_c, the segments with nearest centroids that each is compared with; 0 stands for all of up
    /// to 300 segments, and for 20 of more.
    std::size_t candidates = 0;
};

/// The gap between two segments whose merging was considered, and what became of it.
struct considered_gap {
    std::vector<boundary_pair> lines;
    bool merged;
};

/// Segments after merging, and every gap that was looked into, in the order of the rounds.
struct merged_segments {
    gnomon::segments segments;
    std::vector<considered_gap> gaps;
};

namespace detail {

/// Whether a policy accepts a line: more of its places speak for merging than against. Where the
/// surface itself is seen, nothing speaks against it; a line without a place says what nothing
/// says.
template <merge_policy M>
[[nodiscard]] bool accepts(const M& policy, const sighting_count& seen) {
    if (seen.total() == 0) return policy(sighting::unseen);
    std::size_t in_favor = 0, against = 0;
    for (const sighting s :
         {sighting::unseen, sighting::closer, sighting::level, sighting::farther}) {
        if (policy(s))
            in_favor += seen[s];
        else if (s != sighting::level)
            against += seen[s];
    }
    return in_favor > against;
}

/// One run of the algorithm.
template <class R, merge_policy M, class Proj>
class occlusion_merger {
  public:
    occlusion_merger(const R& points, const segments& parts, const lines_of_sight& sights,
                     const M& policy, const occlusion_merging& options, Proj projection)
        : range_(points),
          projection_(std::move(projection)),
          points_(points, projection_),
          sights_(sights),
          viewpoints_(viewpoints_of(points)),
          policy_(policy),
          options_(options) {
        for (std::size_t s = 0; s < parts.size(); ++s) {
            members_.emplace_back(parts[s].begin(), parts[s].end());
            frames_.push_back(frame_of(members_.back()));
            planes_.push_back(plane_of(members_.back()));
            changed_.push_back(true);
        }
    }

    [[nodiscard]] merged_segments operator()() {
        while (merge_once()) {
        }
        return {segments_of_groups(points_.size(), members_), std::move(gaps_)};
    }

  private:
    /// One round.
    /// @return whether it merged any
    bool merge_once() {
        union_find sets(members_.size());
        bool any = false;
        for (const auto& [i, j] : pairs_to_compare(frames_, options_.candidates,
                                                   [this](const auto& f) { return is_flat(f); })) {
            if (!(changed_[i] || changed_[j]) || !are_of_one_plane(i, j)) continue;
            considered_gap gap{
                boundary_pairs(points_, members_[i], members_[j],
                               {frames_[i].centroid, frames_[j].centroid}, options_.boundary_pairs),
                false};
            gap.merged = spans(gap.lines);
            if (gap.merged) sets.unite(i, j);
            any = any || gap.merged;
            gaps_.push_back(std::move(gap));
        }
        if (any) gather(sets);
        return any;
    }

    [[nodiscard]] principal_frame frame_of(std::span<const point_index> members) const {
        return principal_frame_of(subset_view<R, Proj>(range_, members, projection_));
    }

    [[nodiscard]] plane_sample plane_of(std::span<const point_index> members) const {
        return plane_sample_of(points_, members, viewpoints_, options_.sigma);
    }

    /// A segment no thicker than twice the noise is flat, whatever its variation.
    [[nodiscard]] bool is_flat(const principal_frame& a) const {
        return a.spectrum.surface_variation() <= options_.max_variation ||
               a.spectrum.lambda[2] <= 4.0 * options_.sigma * options_.sigma;
    }

    [[nodiscard]] bool are_of_one_plane(std::size_t i, std::size_t j) const {
        const bool first = frames_[i].spectrum.lambda[1] >= frames_[j].spectrum.lambda[1];
        const std::size_t wide = first ? i : j, slim = first ? j : i;
        return plane_comparison(planes_[wide], planes_[slim], options_.sigma)
            .is_of_one(options_.max_angle, options_.max_offset);
    }

    /// Whether most of the lines across a gap are accepted by the policy, or, where it is narrow,
    /// by whoever merges unless something farther is seen. A gap that is seen through at one place
    /// is one, be there ever so much in front of the others.
    [[nodiscard]] bool spans(std::span<const boundary_pair> lines) const {
        std::size_t accepted = 0, passable = 0;
        for (const boundary_pair& line : lines) {
            const Eigen::Vector3d v =
                detail::combined(0.5, viewpoints_[line.first], 0.5, viewpoints_[line.second]);
            const sighting_count seen =
                sights_.between(points_[line.first], points_[line.second], v);
            if (seen[sighting::farther] > 0 && !policy_(sighting::farther)) return false;
            accepted += accepts(policy_, seen) ? 1 : 0;
            passable += accepts(liberal{}, seen) ? 1 : 0;
        }
        return 2 * accepted > lines.size() ||
               (coplanar_distance(lines) < options_.max_gap && 2 * passable > lines.size());
    }

    /// Makes one segment of each set.
    void gather(union_find& sets) {
        std::fill(changed_.begin(), changed_.end(), false);
        for (std::size_t s = 0; s < members_.size(); ++s) {
            const point_index root = sets.find(static_cast<point_index>(s));
            if (root == s) continue;
            members_[root].insert(members_[root].end(), members_[s].begin(), members_[s].end());
            members_[s].clear();
            changed_[root] = true;
        }
        std::size_t kept = 0;
        for (std::size_t s = 0; s < members_.size(); ++s) {
            if (members_[s].empty()) continue;
            if (changed_[s]) {
                std::sort(members_[s].begin(), members_[s].end());
                frames_[s] = frame_of(members_[s]);
                planes_[s] = plane_of(members_[s]);
            }
            if (kept != s) {
                members_[kept] = std::move(members_[s]);
                frames_[kept] = frames_[s];
                planes_[kept] = planes_[s];
                changed_[kept] = changed_[s];
            }
            ++kept;
        }
        members_.resize(kept);
        frames_.resize(kept);
        planes_.resize(kept);
        changed_.resize(kept);
    }

    const R& range_;
    Proj projection_;
    position_view<R, Proj> points_;
    const lines_of_sight& sights_;
    viewpoint_table viewpoints_;
    const M& policy_;
    const occlusion_merging& options_;
    std::vector<std::vector<point_index>> members_;
    std::vector<principal_frame> frames_;
    std::vector<plane_sample> planes_;
    std::vector<bool> changed_;  // since the round before
    std::vector<considered_gap> gaps_;
};

}  // namespace detail

/// Merges flat segments that are one surface behind something.
///
/// @param points  any point range of n points; their view points as in `lines_of_sight`
/// @param parts   segments of these points
/// @param sights  what was seen from where, best by the whole cloud
/// @param policy  `conservative`, `liberal` or another
/// @throws std::invalid_argument  if the segments are of another number of points, for an odd or no
///                                number of boundary pairs, or a negative or NaN threshold
/// Complexity: per round O(candidates * (n + pixels of the gaps)); rounds are few.
template <class R, merge_policy M = conservative, class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const segments& parts,
                                             const lines_of_sight& sights, const M& policy = {},
                                             const occlusion_merging& options = {},
                                             Proj projection = {}) {
    detail::require(parts.labels().size() == position_view<R, Proj>(points, projection).size(),
                    "merge_occluded: the segments are of other points");
    detail::require(options.boundary_pairs > 0 && options.boundary_pairs % 2 == 0,
                    "merge_occluded: the number of boundary pairs must be even and not 0");
    detail::require(options.max_variation >= 0.0 && options.max_offset >= 0.0 &&
                        options.max_gap >= 0.0 && options.max_angle.radians() >= 0.0,
                    "merge_occluded: a threshold is negative or NaN");
    detail::require(options.sigma > 0.0, "merge_occluded: sigma must be greater than 0");
    return detail::occlusion_merger(points, parts, sights, policy, options,
                                    std::move(projection))();
}

}  // namespace gnomon
