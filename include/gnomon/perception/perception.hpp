// SPDX-License-Identifier: BSL-1.0
/// @file
/// The whole chain in one object, from a scan to its surfaces: removal of floor and ceiling,
/// normals and their orientation, segmentation into smooth surfaces, merging of occluded segments,
/// assignment of unlabeled points and joining of surfaces of revolution. Each step is a policy of
/// its own floor; the result holds what each step returned and how long it took. All steps share
/// one index of the points (Klasing 2010, Fig. 4.2, Table 4.1).
///
///     const gnomon::perception<> chain{.neighborhood = {.k = 50}};
///     auto seen = chain(scan, gnomon::threads{});
///
/// and for each further scan, in the same memory:
///
///     chain.into(seen, next_scan, team);
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <utility>

#include <gnomon/core/detail/refused_points.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/perception_run.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/segmentation/assign_unlabeled.hpp>
#include <gnomon/segmentation/join_surfaces_of_revolution.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>
#include <gnomon/segmentation/split_outliers.hpp>

namespace gnomon {

/// What is removed first: floor and ceiling, where they are found.
struct floor_and_ceiling {
    Eigen::Vector3d up = Eigen::Vector3d(0.0, 0.0, 1.0);  ///< against gravity, of unit length
    find_floor_options floor{};
    find_ceiling_options ceiling{};
    crop_height_options bands{};
};

/// In place of a merge policy: no occluded segments are merged.
struct no_merging {};

/// The chain, ready to be called on one scan after the other.
///
/// `neighborhood` is any model of `neighborhood`, `estimate` of `estimator`, `merge` of
/// `merge_policy`, or `no_merging{}`. Name these three, and the types follow; by members, name the
/// types, as in `perception<>{.leave_out = floor_and_ceiling{}}` or
/// `perception<knn, plane_pca, liberal>{.visibility = {.sigma = 0.01}}`.
template <class Neighborhood = knn, class Estimator = plane_pca, class Merge = conservative>
struct perception {
    static_assert(merge_policy<Merge> || std::same_as<Merge, no_merging>,
                  "perception: merge by a merge_policy, or by no_merging{}");

    Neighborhood neighborhood{};
    Estimator estimate{};
    Merge merge{};
    segment_surfaces_options segmentation{};
    merge_occluded_options merging{};
    visibility_options visibility{};
    std::optional<floor_and_ceiling> leave_out = std::nullopt;
    /// Anisotropic neighborhoods are estimated again from doubled k (Eq. 3.19), where policy and
    /// estimator can.
    repair_anisotropic_options repair{};
    /// Unlabeled points are assigned to planar segments.
    std::optional<assign_unlabeled_options> assignment = assign_unlabeled_options{};
    /// Before that, outliers of planar segments are split off, and segments merged once more.
    std::optional<split_outliers_options> splitting = split_outliers_options{};
    /// At the end, oversegmented surfaces of revolution are joined.
    std::optional<join_surfaces_of_revolution_options> revolution =
        join_surfaces_of_revolution_options{};

    /// The same chain for ranges of this standard deviation [m], in the steps after the normals.
    /// The estimator and the neighborhood keep their own.
    [[nodiscard]] perception with_sigma(double sigma) const {
        perception chain = *this;
        chain.merging.sigma = chain.visibility.sigma = sigma;
        if (chain.assignment) chain.assignment->sigma = sigma;
        if (chain.splitting) chain.splitting->sigma = sigma;
        if (chain.revolution) chain.revolution->sigma = sigma;
        return chain;
    }

    using result_type = perception_result<estimate_t<Estimator>>;

    /// Perceives n points: any point range, or an index of it; their view points as everywhere.
    /// @throws std::invalid_argument  what the steps throw, for parameters out of range, and if the
    ///                                view point of a point with a normal is not finite
    /// Complexity: that of the steps.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    [[nodiscard]] result_type operator()(const R& points, const X& run = {},
                                         Proj projection = {}) const {
        result_type result;
        into(result, points, run, std::move(projection));
        return result;
    }

    /// The same, in the memory of `result`, whose content it replaces. If this throws, the content
    /// is unspecified, and can be replaced by the next call. Precondition: the points do not refer
    /// to the result, unless they are its index itself.
    template <class R, execution X = sequential, class Proj = std::identity>
        requires point_range<R, Proj>
    void into(result_type& result, const R& points, const X& run = {}, Proj projection = {}) const {
        if constexpr (std::same_as<R, spatial_index> && std::same_as<Proj, std::identity>) {
            if (&points == &result.index) {
                const spatial_index given = std::move(result.index);
                return into(result, given, run, std::move(projection));
            }
        }
        const auto& team = detail::staying(run);
        detail::perception_run(*this, points, result, team, projection)();
    }

    /// Refused: the result of another estimator than that of this chain.
    template <class Other>
        requires(!std::same_as<Other, estimate_t<Estimator>>)
    void into(perception_result<Other>&, const auto&...) const {
        static_assert(detail::never<Other>,
                      "the result is of another estimator: write decltype(chain)::result_type");
    }
};

/// For clang, which does not deduce the parameters of an aggregate by itself.
template <class Neighborhood, class Estimator, class Merge>
perception(Neighborhood, Estimator, Merge, segment_surfaces_options = {},
           merge_occluded_options = {}, visibility_options = {},
           std::optional<floor_and_ceiling> = std::nullopt, repair_anisotropic_options = {},
           std::optional<assign_unlabeled_options> = assign_unlabeled_options{},
           std::optional<split_outliers_options> = split_outliers_options{},
           std::optional<join_surfaces_of_revolution_options> =
               join_surfaces_of_revolution_options{}) -> perception<Neighborhood, Estimator, Merge>;

}  // namespace gnomon
