// SPDX-License-Identifier: BSL-1.0
/// @file
/// Merging of occluded segments: flat coplanar segments are merged where the observations in the
/// gap between them are evidence for one surface.
///
/// Klasing 2010, Sec. 4.3, Alg. 4.3, in a form that does not depend on the order: in rounds, the
/// most alike first, until no two are alike. After each round the planes are those of the merged
/// segments, so that merging the result again changes nothing. Coplanarity is a test of all points
/// of both (Chow 1960), so that two planes are not joined through a third segment that would be of
/// either. A narrow gap, which the thesis always closes, stays open where free space was observed
/// (docs/thesis-notes.md, A18). merge_occluded_literally is the algorithm as printed.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include <gnomon/core/detail/union_find.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/boundary_pairs.hpp>
#include <gnomon/occlusion/detail/occlusion_merger.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/segmentation/detail/planar_cloud.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// Parameters of `merge_occluded`.
struct merge_occluded_options {
    noise_curve noise = constant_noise{};  ///< along the rays
    double max_offset = 0.05;              ///< rho_o between coplanar segments side by side [m]
    /// rho_c [m]: narrower gaps are closed whatever the policy, unless free space was observed in
    /// them.
    double max_gap = 0.20;
    std::size_t boundary_pairs = 6;  ///< n_b, an even number
    /// k_c, the coplanar segments with nearest centroids that each is compared with; performance
    /// only: in furnished rooms 20,001 to 20,024 all as candidates give the same result.
    std::size_t candidates = 20;
};

/// The gap between two segments whose merging was considered, and whether they were merged.
struct considered_gap {
    /// Between the nearest boundary points of both: their numbers `first` and `second` in the
    /// cloud, and their `distance` [m]. By `planes_on_cells`, `first` and `second` are a point of
    /// each of two cells, one in each segment, and `distance` is between the means of these cells.
    std::vector<detail::boundary_pair> lines;
    observation_count seen;  ///< along all of them
    bool merged;             ///< whether both are one segment now

    /// rho_c, the least length of the lines [m], Eq. (4.7); infinite if there are none.
    [[nodiscard]] double width() const { return detail::coplanar_distance(lines); }
};

/// Segments after merging, and every gap that was considered, in the order of the rounds.
struct merged_segments {
    gnomon::segments segments;         ///< largest first
    std::vector<considered_gap> gaps;  ///< one for each pair that was considered
};

namespace detail {

/// @throws std::invalid_argument  for what no form of the algorithm can work with
void require_pairs(const auto& options) {
    require(options.boundary_pairs > 0 && options.boundary_pairs % 2 == 0,
            "merging: the number of boundary pairs must be even and not 0");
    require(options.candidates > 0, "merging: there must be a candidate");
}

inline void require_valid(const merge_occluded_options& options) {
    require_pairs(options);
    require(options.max_offset >= 0.0 && options.max_gap >= 0.0,
            "merge_occluded: max_offset and max_gap must not be negative or NaN");
}

/// The sets of the segments of an index that merge_occluded makes one.
/// @param cloud     of the points
/// @param each_gap  each_gap(examined_gap) is called for all gaps
template <merge_policy M, execution X>
[[nodiscard]] union_find merged_sets(const spatial_index& points, const planar_cloud& cloud,
                                     const segments& parts, const visibility& visible,
                                     const M& policy, const merge_occluded_options& options,
                                     const X& run, auto&& each_gap) {
    require(parts.labels().size() == points.size(),
            "merge_occluded: the numbers of points and of labels differ");
    require_valid(options);
    occlusion_merger merge(points, cloud, parts, visible, policy, options, run);
    union_find sets = merge();
    for (const examined_gap& gap : merge.gaps()) each_gap(gap);
    return sets;
}

}  // namespace detail

/// Merges flat segments that are one surface behind something.
///
/// @param points   any point range of n points [m]; their view points as in `visibility`
/// @param parts    segments of these points
/// @param visible  what was seen from where, best by the whole cloud
/// @param policy   `conservative`, `liberal` or another
/// @return the segments afterwards, largest first, and all gaps that were examined; the same for
///         every execution
/// @throws std::invalid_argument  if the segments or view points are of another number of points,
///                                for an odd or no number of boundary pairs, no candidate, or a
///                                negative or NaN threshold
/// Complexity: per round, which are few, O(m log m) for the pairs of m segments, or O(m^2) if all
/// are compared, and O(candidates * (n + pixels of the gaps * images)); and an index if `points` is
/// none.
template <class R, merge_policy M = conservative, execution X = sequential,
          class Proj = std::identity>
    requires point_range<R, Proj>
[[nodiscard]] merged_segments merge_occluded(const R& points, const segments& parts,
                                             const visibility& visible, const M& policy = {},
                                             const merge_occluded_options& options = {},
                                             const X& run = {}, Proj projection = {}) {
    merged_segments result;
    const auto& team = detail::staying(run);
    const auto& index = detail::index_of(points, team, projection);
    // The origin stands for unknown view points, as in `visibility`.
    const detail::planar_cloud cloud(index, options.noise, team, true);
    detail::union_find sets = detail::merged_sets(
        index, cloud, parts, visible, policy, options, team, [&](const detail::examined_gap& gap) {
            result.gaps.push_back({{gap.lines.begin(), gap.lines.end()}, gap.seen, gap.merged});
        });
    result.segments = detail::united_segments(parts, sets);
    return result;
}

}  // namespace gnomon
