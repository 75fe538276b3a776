// SPDX-License-Identifier: BSL-1.0
/// @file
/// Merging of occluded segments: flat coplanar segments are merged where the observations in the
/// gap between them are evidence for one surface.
///
/// Klasing 2010, Sec. 4.3, Alg. 4.3, in a form that does not depend on the order: in rounds, each
/// of which tests all pairs with a new segment and merges the accepted ones, until there are none.
/// Two segments that are certainly not coplanar are not joined through a third one. A narrow gap,
/// which the thesis always closes, stays open where free space was observed (docs/thesis-notes.md,
/// A18). Coplanarity is a test on the regressions of the ranges, and for adjacent narrow segments
/// also on their normals. merge_occluded_literally is the algorithm as printed.
#pragma once

#include <cstddef>
#include <functional>
#include <iterator>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/detail/scratch.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/fragment.hpp>
#include <gnomon/occlusion/detail/occlusion_merger.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of Alg. 4.3, with the thesis's values (Sec. 4.4.1).
struct merge_occluded_options {
    double max_variation =
        0.15;  ///< sigma_sv,max of a flat segment, Eq. (3.28): 0 a plane, 1 a ball
    angle max_angle = degrees(15);  ///< rho_a between coplanar segments
    double max_offset = 0.05;       ///< rho_o of coplanar segments [m]
    /// rho_c [m]: narrower gaps are closed whatever the policy, unless free space was observed in
    /// them or their sides are too narrow to determine that they are one surface.
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

/// The gap between two segments whose merging was considered, and whether they were merged.
struct considered_gap {
    /// Between the nearest boundary points of both: their numbers `first` and `second` in the
    /// cloud, and their `distance` [m].
    std::vector<detail::boundary_pair> lines;
    observation_count seen;  ///< along all of them
    bool merged;

    /// rho_c, the least length of the lines [m], Eq. (4.7); infinite if there are none.
    [[nodiscard]] double width() const { return detail::coplanar_distance(lines); }
};

/// Segments after merging, and every gap that was considered, in the order of the rounds.
struct merged_segments {
    gnomon::segments segments;
    std::vector<considered_gap> gaps;
};

namespace detail {

/// Refuses what no form of the algorithm can work with.
inline void require_thresholds(const merge_occluded_options& options) {
    require(options.boundary_pairs > 0 && options.boundary_pairs % 2 == 0,
            "merge_occluded_options: the number of boundary pairs must be even and not 0");
    require(options.max_variation >= 0.0 && options.max_offset >= 0.0 && options.max_gap >= 0.0 &&
                options.max_angle.radians() >= 0.0,
            "merge_occluded_options: a threshold is negative or NaN");
}

/// Normals of points without any.
struct no_normals {
    struct element {
        Eigen::Vector3d normal{0.0, 0.0, 0.0};
    };
    [[nodiscard]] element operator[](std::size_t) const { return {}; }
};

/// merge_occluded(), in the memory of `result`, which may be `parts`.
/// @param known      fragments of the first run for a second one with the same points, normals and
///                   options; none for the first run. Becomes those of this run.
/// @param each_gap   each_gap(examined_gap) is called for all gaps, in the order of the rounds
template <class R, class Normals, merge_policy M, execution X, class Proj>
void merge_occluded_into(segments& result, const R& points, const Normals& normals,
                         const segments& parts, const visibility& visible, const M& policy,
                         const merge_occluded_options& options, const X& run,
                         const Proj& projection, scratch<fragment>& known, auto&& each_gap) {
    const position_view<R, Proj> p(points, projection);
    require(parts.labels().size() == p.size(),
            "merge_occluded: the numbers of points and of labels differ");
    require_thresholds(options);
    require(options.sigma > 0.0 && std::isfinite(options.sigma),
            "merge_occluded: sigma must be greater than 0, and finite");
    with_table_of(points, [&](const viewpoint_table& viewpoints) {
        occlusion_merger merge(p, viewpoints, normals, parts, visible, policy, options, run, known);
        merge();
        result.assign(merge.labels());
        for (const examined_gap& gap : merge.gaps()) each_gap(gap);
        known = merge.take_fragments();
    });
}

/// The same without a second run.
template <class R, class Normals, merge_policy M, execution X, class Proj>
[[nodiscard]] merged_segments merged_once(const R& points, const Normals& normals,
                                          const segments& parts, const visibility& visible,
                                          const M& policy, const merge_occluded_options& options,
                                          const X& run, const Proj& projection) {
    merged_segments result;
    scratch<fragment> none;
    merge_occluded_into(
        result.segments, points, normals, parts, visible, policy, options, run, projection, none,
        [&result](const examined_gap& gap) {
            result.gaps.push_back({{gap.lines.begin(), gap.lines.end()}, gap.seen, gap.merged});
        });
    return result;
}

}  // namespace detail

/// Merges flat segments that are one surface behind something.
///
/// @param points   any point range of n points; their view points as in `visibility`
/// @param surface  their n surface elements, or anything with normals towards the view points; what
///                 has none is judged without
/// @param parts    segments of these points
/// @param visible   what was seen from where, best by the whole cloud
/// @param policy   `conservative`, `liberal` or another
/// @throws std::invalid_argument  if the surface or the segments are of another number of points,
///                                for an odd or no number of boundary pairs, a negative or NaN
///                                threshold, or a sigma that is not finite and
///                                greater than 0
/// Complexity: per round O(candidates * (n + pixels of the gaps * view points)); rounds are few.
template <class R, normal_range Surface, merge_policy M = conservative, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const Surface& surface,
                                             const segments& parts, const visibility& visible,
                                             const M& policy = {},
                                             const merge_occluded_options& options = {},
                                             const X& run = {}, Proj projection = {}) {
    detail::require(std::ranges::size(surface) == parts.labels().size(),
                    "merge_occluded: surface and points differ in size");
    return detail::merged_once(points, surface, parts, visible, policy, options, run, projection);
}

/// The same without normals: more adjacent narrow segments are merged.
template <class R, merge_policy M = conservative, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const segments& parts,
                                             const visibility& visible, const M& policy = {},
                                             const merge_occluded_options& options = {},
                                             const X& run = {}, Proj projection = {}) {
    return detail::merged_once(points, detail::no_normals{}, parts, visible, policy, options, run,
                               projection);
}

}  // namespace gnomon
