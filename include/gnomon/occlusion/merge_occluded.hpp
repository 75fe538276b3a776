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
#include <gnomon/core/detail/vector3.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/core/symmetric_eigen.hpp>
#include <gnomon/core/union_find.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/features/principal_frame.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/gap_verdict.hpp>
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
    bool merged;
};

/// Segments after merging, and every gap that was looked into, in the order of the rounds.
struct merged_segments {
    gnomon::segments segments;
    std::vector<considered_gap> gaps;
};

namespace detail {

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
        require(options.boundary_pairs > 0 && options.boundary_pairs % 2 == 0,
                "merge_occluded: the number of boundary pairs must be even and not 0");
        require(options.max_variation >= 0.0 && options.max_offset >= 0.0 &&
                    options.max_gap >= 0.0 && options.max_angle.radians() >= 0.0,
                "merge_occluded: a threshold is negative or NaN");
        require(options.sigma > 0.0, "merge_occluded: sigma must be greater than 0");
        for (std::size_t s = 0; s < parts.size(); ++s)
            surfaces_.push_back(surface_of({parts[s].begin(), parts[s].end()}));
    }

    [[nodiscard]] merged_segments operator()() {
        while (merge_once()) {
        }
        return {segments_of_groups(points_.size(), surfaces_, &surface::members), std::move(gaps_)};
    }

  private:
    /// A segment as it is in a round.
    struct surface {
        std::vector<point_index> members;
        std::vector<point_index> on_plane;  ///< of these, once asked for
        principal_frame frame;
        plane_sample plane;
        Eigen::Vector3d normal;  ///< of its plane, or else the sum of those of its points
        bool is_spot;            ///< narrower than noise
        bool is_known;           ///< tells the direction of its plane by itself
        bool is_new = true;      ///< since the round before
    };

    [[nodiscard]] surface surface_of(std::vector<point_index> members) const {
        const auto frame = principal_frame_of(subset_view<R, Proj>(range_, members, projection_));
        const auto plane = plane_sample_of(points_, members, viewpoints_, options_.sigma);
        const plane_knowledge known = knowledge_of(plane, options_.sigma);
        const bool is_known = known.direction <= options_.max_angle;
        const Eigen::Vector3d normal = is_known ? known.normal : sum_of_normals(members);
        return {.members = std::move(members),
                .on_plane = {},
                .frame = frame,
                .plane = plane,
                .normal = normal,
                .is_spot = known.squared_width < options_.sigma * options_.sigma,
                .is_known = is_known};
    }

    [[nodiscard]] Eigen::Vector3d sum_of_normals(std::span<const point_index> members) const {
        Eigen::Vector3d sum(0.0, 0.0, 0.0);
        for (const point_index i : members) {
            const Eigen::Vector3d normal = normals_[i].normal;
            if (is_finite(normal)) sum = combined(1.0, sum, 1.0, normal);
        }
        return sum;
    }

    /// A gap that may be closed.
    struct link {
        point_index first, second;  ///< the surfaces on both sides
        double offset;              ///< of one from the plane of the other [m]
        std::size_t gap;            ///< its number
    };

    /// One round.
    /// @return whether it merged any
    bool merge_once() {
        std::vector<link> links;
        for (const auto& [i, j] : pairs_to_compare(
                 surfaces_, options_.candidates, [this](const surface& s) { return is_flat(s); },
                 &surface::frame)) {
            surface &a = surfaces_[i], &b = surfaces_[j];
            if (!a.is_new && !b.is_new) continue;
            const plane_comparison planes = planes_of(a, b);
            if (!planes.is_of_one(options_.max_angle, options_.max_offset)) continue;
            considered_gap gap{
                boundary_pairs(points_, body_of(a), body_of(b),
                               {a.frame.centroid, b.frame.centroid}, options_.boundary_pairs),
                false};
            if (is_closed(gap.lines, may_adjoin(a, b)))
                links.push_back({i, j, planes.offset(), gaps_.size()});
            gaps_.push_back(std::move(gap));
        }
        if (links.empty()) return false;
        union_find sets = sets_of(links);
        for (const link& l : links) gaps_[l.gap].merged = sets.find(l.first) == sets.find(l.second);
        gather(sets);
        return true;
    }

    /// What the links join, the closest planes first. A surface that tells little of its plane may
    /// be of one with two that are certainly of two: it does not join these, each set being judged
    /// by its largest surface.
    [[nodiscard]] union_find sets_of(std::vector<link>& links) const {
        std::sort(links.begin(), links.end(), [this](const link& a, const link& b) {
            if (a.offset != b.offset) return a.offset < b.offset;
            return coplanar_distance(gaps_[a.gap].lines) < coplanar_distance(gaps_[b.gap].lines);
        });
        union_find sets(surfaces_.size());
        std::vector<point_index> largest(surfaces_.size());
        std::iota(largest.begin(), largest.end(), point_index{0});
        for (const link& l : links) {
            const point_index a = largest[sets.find(l.first)], b = largest[sets.find(l.second)];
            if (planes_of(surfaces_[a], surfaces_[b])
                    .is_of_two(options_.max_angle, options_.max_offset))
                continue;
            const bool first = surfaces_[a].members.size() >= surfaces_[b].members.size();
            largest[sets.unite(l.first, l.second)] = first ? a : b;
        }
        return sets;
    }

    /// A segment is flat, whatever its variation, if three points in four are in one plane, no
    /// thicker than twice the noise: the others may be round a corner.
    [[nodiscard]] bool is_flat(const surface& s) const {
        return s.frame.spectrum.surface_variation() <= options_.max_variation ||
               (4 * s.plane.count >= 3 * s.members.size() &&
                symmetric_eigen(s.plane.covariance).values[2] <=
                    4.0 * options_.sigma * options_.sigma);
    }

    /// The points that a gap begins at: those on the plane, if they are three in four.
    [[nodiscard]] std::span<const point_index> body_of(surface& s) const {
        if (s.on_plane.empty())
            s.on_plane = points_on_plane(points_, s.members, s.plane, options_.sigma);
        return 4 * s.on_plane.size() >= 3 * s.members.size() ? s.on_plane : s.members;
    }

    /// Whether two surfaces that nothing hides between may go on in one another. What is hardly
    /// wider than noise tells too little of its plane for that: its normals must be like those of
    /// the other, and near a right angle are blended by half of it at most; those of a spot are
    /// noise, so that the other must be known.
    [[nodiscard]] static bool may_adjoin(const surface& a, const surface& b) {
        if (a.is_spot || b.is_spot) return a.is_known || b.is_known;
        constexpr double blended = 0.5;                 // the square of the cosine of 45 degrees
        const double cosine = dot(a.normal, b.normal);  // times both lengths
        return cosine >= 0.0 &&
               cosine * cosine >= blended * dot(a.normal, a.normal) * dot(b.normal, b.normal);
    }

    [[nodiscard]] plane_comparison planes_of(const surface& a, const surface& b) const {
        const bool first = a.frame.spectrum.lambda[1] >= b.frame.spectrum.lambda[1];
        return {(first ? a : b).plane, (first ? b : a).plane, options_.sigma};
    }

    /// Whether most of the lines across a gap are accepted by the policy, or, where it is narrow
    /// and its sides may adjoin, by whoever merges unless something farther is seen.
    [[nodiscard]] bool is_closed(std::span<const boundary_pair> lines, bool may_adjoin) const {
        std::size_t accepted = 0, passable = 0;
        for (const boundary_pair& line : lines) {
            const Eigen::Vector3d v =
                detail::combined(0.5, viewpoints_[line.first], 0.5, viewpoints_[line.second]);
            const sighting_count seen =
                sights_.between(points_[line.first], points_[line.second], v);
            if (keeps_open(policy_, seen)) return false;
            accepted += accepts(policy_, seen) ? 1 : 0;
            passable += accepts(liberal{}, seen) ? 1 : 0;
        }
        return 2 * accepted > lines.size() ||
               (may_adjoin && coplanar_distance(lines) < options_.max_gap &&
                2 * passable > lines.size());
    }

    /// Makes one segment of each set.
    void gather(union_find& sets) {
        for (surface& s : surfaces_) s.is_new = false;
        for (std::size_t s = 0; s < surfaces_.size(); ++s) {
            const point_index root = sets.find(static_cast<point_index>(s));
            if (root == s) continue;
            auto &from = surfaces_[s].members, &to = surfaces_[root].members;
            to.insert(to.end(), from.begin(), from.end());
            from.clear();
            surfaces_[root].is_new = true;
        }
        std::erase_if(surfaces_, [](const surface& s) { return s.members.empty(); });
        for (surface& s : surfaces_) {
            if (!s.is_new) continue;
            std::sort(s.members.begin(), s.members.end());
            s = surface_of(std::move(s.members));
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
    std::vector<surface> surfaces_;
    std::vector<considered_gap> gaps_;
};

}  // namespace detail

/// Merges flat segments that are one surface behind something.
///
/// @param points   any point range of n points; their view points as in `lines_of_sight`
/// @param surface  their n surface elements, or anything with normals, towards the view points;
/// what
///                 has none is judged without
/// @param parts    segments of these points
/// @param sights   what was seen from where, best by the whole cloud
/// @param policy   `conservative`, `liberal` or another
/// @throws std::invalid_argument  if the surface or the segments are of another number of points,
///                                for an odd or no number of boundary pairs, a negative or NaN
///                                threshold, or a sigma that is not greater than 0
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
