// SPDX-License-Identifier: BSL-1.0
/// @file
/// The whole way from a scan to its surfaces in one object: what is left out first, who a point's
/// neighbors are, how a normal is estimated, what a smooth surface is, and what becomes of surfaces
/// torn by something in front, of stray points and of round things. Each step is a policy of its
/// own floor, and the result tells what each of them gave and how long it took (Klasing 2010,
/// Fig. 4.2, Table 4.1).
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <thread>  // has the clocks of <chrono> without its calendars, which take long to read
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/execution.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/core/subset_view.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/anisotropy.hpp>
#include <gnomon/normals/estimate_normals.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/orient.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/occlusion/lines_of_sight.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/segmentation/claim_strays.hpp>
#include <gnomon/segmentation/join_round.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/release_strays.hpp>
#include <gnomon/segmentation/segments.hpp>
#include <gnomon/segmentation/surface_segmentation.hpp>

namespace gnomon {

/// Stands for a merge policy where torn surfaces are to stay torn.
struct unmerged {};

/// What to leave out before all else: floor and ceiling, where there are any.
struct floor_and_ceiling {
    Eigen::Vector3d up = Eigen::Vector3d(0.0, 0.0, 1.0);  ///< against gravity, of unit length
    floor_search floor{};
    ceiling_search ceiling{};
    height_bands bands{};
};

/// How long the steps took [s].
struct perception_seconds {
    double preprocessing = 0.0;  ///< finding floor and ceiling
    double normals = 0.0;        ///< and their repair and orientation
    double segmentation = 0.0;
    double merging = 0.0;   ///< and range images
    double claiming = 0.0;  ///< and releasing, of strays, and joining of what is round
};

/// What was perceived in n points.
template <class Estimate>
struct perceived {
    std::optional<plane> floor;             ///< as it was found, if it was looked for
    std::optional<double> ceiling;          ///< its height above the floor [m]
    std::vector<point_index> kept;          ///< the points that were not left out, ascending
    std::vector<surfel<Estimate>> surface;  ///< n; without a normal where left out
    segments fragments;                     ///< of the n points, before merging
    segments surfaces;                      ///< after merging and all that follows it
    std::vector<considered_gap> gaps;       ///< what merging looked into, and what it closed later
    perception_seconds seconds;
};

/// The chain, ready to be called on one scan after the other.
///
/// `neighborhood` is any model of `neighborhood`, `estimate` of `estimator`, `merge` of
/// `merge_policy`, or `unmerged{}`. Name these three, and the types follow; by members, name the
/// types, as in `perception<>{.leave_out = floor_and_ceiling{}}` or
/// `perception<knn, plane_pca, liberal>{.sights = {.sigma = 0.01}}`.
template <class Neighborhood = knn, class Estimator = plane_pca, class Merge = conservative>
struct perception {
    static_assert(merge_policy<Merge> || std::same_as<Merge, unmerged>,
                  "perception: merge by a merge_policy, or by unmerged{}");

    Neighborhood neighborhood{};
    Estimator estimate{};
    Merge merge{};
    surface_segmentation segmentation{};
    occlusion_merging merging{};
    sight_options sights{};
    std::optional<floor_and_ceiling> leave_out = std::nullopt;
    /// Needles among the neighborhoods are widened (Eq. 3.19), where policy and estimator can.
    anisotropy_repair repair{};
    /// Points without a segment go to flat ones that they are of.
    std::optional<stray_claiming> strays = stray_claiming{};
    /// Before that, flat segments free what is not of their planes, and are merged once more.
    std::optional<stray_releasing> releasing = stray_releasing{};
    /// At the end, vases, cups and columns that fell apart become one segment each.
    std::optional<round_joining> round = round_joining{};

    /// The same chain for ranges of this standard deviation [m], in all steps that know of noise.
    [[nodiscard]] perception with_sigma(double sigma) const {
        perception chain = *this;
        chain.merging.sigma = chain.sights.sigma = sigma;
        if (chain.strays) chain.strays->sigma = sigma;
        if (chain.releasing) chain.releasing->sigma = sigma;
        if (chain.round) chain.round->sigma = sigma;
        return chain;
    }

    /// Perceives n points: any point range; their view points as everywhere.
    /// @throws std::invalid_argument  what the steps throw, for parameters out of range, and if the
    ///                                view point of a point with a normal is not finite
    /// Complexity: that of the steps; normals are the dearest of most scans.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] auto operator()(const R& points, const X& run = {}, Proj projection = {}) const
        -> perceived<estimate_t<Estimator>> {
        result_type result;
        const std::size_t n = position_view<R, Proj>(points, projection).size();
        result.seconds.preprocessing = seconds_of([&] { keep(points, projection, n, result); });
        const subset_view<R, Proj> kept(points, result.kept, projection);
        std::vector<surfel<estimate_t<Estimator>>> surface;
        result.seconds.normals = seconds_of([&] { surface = surface_of(kept, run); });
        result.seconds.segmentation = seconds_of([&] {
            const segments parts = segment_surfaces(kept, surface, segmentation, run);
            result.fragments = of_all(parts, result.kept, n);
        });
        result.surface.resize(n);
        for (std::size_t i = 0; i < kept.size(); ++i) result.surface[result.kept[i]] = surface[i];
        result.surfaces = result.fragments;
        std::optional<lines_of_sight> seen;
        merge_torn(points, projection, seen, result);
        if (releasing) {
            result.seconds.claiming += seconds_of([&] {
                result.surfaces =
                    of_all(release_strays(kept, surface, surfaces_of_kept(result), *releasing, run),
                           result.kept, n);
            });
            // Pieces tell more of their planes when they are free of what is not of them.
            merge_torn(points, projection, seen, result);
        }
        if (strays || round) {
            result.seconds.claiming += seconds_of([&] {
                segments settled = surfaces_of_kept(result);
                if (strays) settled = claim_strays(kept, settled, *strays, run);
                if (round) settled = join_round(kept, surface, settled, *round, run);
                result.surfaces = of_all(settled, result.kept, n);
            });
        }
        return result;
    }

  private:
    using result_type = perceived<estimate_t<Estimator>>;

    /// Segments of n points from those of the kept ones.
    static segments of_all(const segments& of_kept, const std::vector<point_index>& kept,
                           std::size_t n) {
        std::vector<std::int32_t> labels(n, unlabeled);
        for (std::size_t i = 0; i < kept.size(); ++i) labels[kept[i]] = of_kept.labels()[i];
        return segments(std::move(labels));
    }
    static segments surfaces_of_kept(const result_type& result) {
        std::vector<std::int32_t> labels(result.kept.size());
        for (std::size_t i = 0; i < labels.size(); ++i)
            labels[i] = result.surfaces.labels()[result.kept[i]];
        return segments(std::move(labels));
    }

    /// Merges what is torn of the surfaces, and tells the gaps: all that the first run looks into,
    /// and those that another one closes. What was left out hides and shows as much as the rest.
    /// @param seen  made by the first run
    template <class R, class Proj>
    void merge_torn(const R& points, const Proj& projection, std::optional<lines_of_sight>& seen,
                    result_type& result) const {
        if constexpr (merge_policy<Merge>) {
            result.seconds.merging += seconds_of([&] {
                const bool is_first = !seen;
                if (is_first) seen.emplace(points, sights, projection);
                merged_segments merged = merge_occluded(points, result.surface, result.surfaces,
                                                        *seen, merge, merging, projection);
                result.surfaces = std::move(merged.segments);
                for (considered_gap& gap : merged.gaps)
                    if (is_first || gap.merged) result.gaps.push_back(std::move(gap));
            });
        }
    }

    static double seconds_of(auto&& step) {
        const auto start = std::chrono::steady_clock::now();
        step();
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    }

    template <class R, class Proj>
    void keep(const R& points, const Proj& projection, std::size_t n, result_type& result) const {
        if (leave_out) {
            const auto guess = guess_floor(points, leave_out->up, projection);
            if (guess) result.floor = find_floor(points, *guess, leave_out->floor, projection);
        }
        if (result.floor) {
            result.ceiling = find_ceiling(points, *result.floor, leave_out->ceiling, projection);
            result.kept =
                between_bands(points, *result.floor, result.ceiling, leave_out->bands, projection);
        } else {
            result.kept.resize(n);
            std::iota(result.kept.begin(), result.kept.end(), point_index{0});
        }
    }

    template <class Points, execution X>
    auto surface_of(const Points& points, const X& run) const {
        auto surface = estimate_normals(points, neighborhood, estimate, run);
        if constexpr (requires {
                          repair_anisotropic(points, surface, neighborhood, estimate, repair, run);
                      })
            repair_anisotropic(points, surface, neighborhood, estimate, repair, run);
        orient_normals(points, surface);
        return surface;
    }
};

/// For clang, which does not deduce the parameters of an aggregate by itself.
template <class Neighborhood, class Estimator, class Merge>
perception(Neighborhood, Estimator, Merge, surface_segmentation = {}, occlusion_merging = {},
           sight_options = {}, std::optional<floor_and_ceiling> = std::nullopt,
           anisotropy_repair = {}, std::optional<stray_claiming> = stray_claiming{},
           std::optional<stray_releasing> = stray_releasing{},
           std::optional<round_joining> = round_joining{})
    -> perception<Neighborhood, Estimator, Merge>;

}  // namespace gnomon
