// SPDX-License-Identifier: BSL-1.0
/// @file
/// The whole chain in one object, from a scan to its surfaces: removal of floor and ceiling, the
/// noise of the sensor, normals, planes, and merging of surfaces that an occluder interrupts. Each
/// step is a policy of its own; the result holds what each step returned, and how long it took.
/// All steps share one index of the points, one of their cells, and one noise.
///
///     const gnomon::perception<> chain;
///     auto seen = chain(scan, gnomon::threads{});
///
/// and for each further scan, in the same memory:
///
///     chain.into(seen, next_scan, team);
///
/// The chain of the thesis is (Klasing 2010, Fig. 4.2, Sec. 4.4.1):
///
///     const gnomon::perception<knn, plane_pca, conservative, smooth_surfaces>
///         chain{.noise = constant_noise{0.015}};
#pragma once

#include <concepts>
#include <functional>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/detail/refused_points.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point_range.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/neighborhoods/noise_knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/estimator.hpp>
#include <gnomon/normals/plane_pca.hpp>
#include <gnomon/normals/repair_anisotropic.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/occlusion/merge_policy.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/perception/detail/perception_run.hpp>
#include <gnomon/perception/perception_result.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/segmentation/segment_planes.hpp>
#include <gnomon/segmentation/segment_surfaces.hpp>

namespace gnomon {

/// What is removed first: floor and ceiling, where they are found.
struct floor_and_ceiling {
    Eigen::Vector3d up = Eigen::Vector3d(0.0, 0.0, 1.0);  ///< against gravity, of unit length
    find_floor_options floor{};                           ///< how the floor is found
    find_ceiling_options ceiling{};                       ///< how the ceiling is found
    crop_height_options bands{};                          ///< which points are left out with them

    /// @throws std::invalid_argument  what the search throws for parameters out of range
    void require_valid() const {
        detail::require_hesse({up, 0.0});
        detail::require_valid(floor);
        detail::require_valid(ceiling);
        detail::require_valid(bands);
    }
};

/// In place of a merge policy: no occluded segments are merged.
struct no_merging {};

/// Planes (`segment_planes`), on cells of the points: for every sensor, as the lengths by which
/// planes are found follow from its noise and a flatness of 2 mm. Planes that are pieces of a
/// curved surface become one (segmentation/detail/curved_pieces.hpp). `min_points` counts cells.
struct planes_on_cells {
    segment_planes_options planes{};  ///< angle and number of cells
};

/// The segmentation of the thesis: smooth surfaces, from the normals of all points.
struct smooth_surfaces {
    segment_surfaces_options surfaces{};  ///< thresholds of Alg. 4.2
    /// Anisotropic neighborhoods are estimated again from doubled k (Eq. 3.19), where policy and
    /// estimator can.
    repair_anisotropic_options repair{};
};

/// The chain, ready to be called on one scan after the other.
///
/// `neighborhood` is any model of `neighborhood` that is indexed, `estimate` of `estimator`,
/// `merge` of `merge_policy`, or `no_merging{}`. Whatever has a member `noise` gets that of the
/// chain.
template <class Neighborhood = noise_knn, class Estimator = plane_pca, class Merge = conservative,
          class Segmentation = planes_on_cells>
struct perception {
    static_assert(merge_policy<Merge> || std::same_as<Merge, no_merging>,
                  "perception: merge by a merge_policy, or by no_merging{}");
    static_assert(std::same_as<Segmentation, planes_on_cells> ||
                      std::same_as<Segmentation, smooth_surfaces>,
                  "perception: the segmentation is planes_on_cells, or smooth_surfaces");
    /// Whether planes are found on cells.
    static constexpr bool is_on_cells = std::same_as<Segmentation, planes_on_cells>;

    Neighborhood neighborhood{};  ///< for the normals
    Estimator estimate{};         ///< of normals
    Merge merge{};                ///< which gaps are closed: a `merge_policy`
    Segmentation segmentation{};  ///< `planes_on_cells` or `smooth_surfaces`
    /// Along the rays; by default it is measured. Planes on cells that scatter by more than the
    /// given noise have the measured one.
    std::optional<noise_curve> noise = std::nullopt;
    std::optional<floor_and_ceiling> leave_out = std::nullopt;  ///< by default nothing is
    merge_occluded_options merging{};                           ///< which segments are coplanar
    visibility_options visibility{};                            ///< the range images of the merging

    /// @throws std::invalid_argument  what the steps throw for parameters of the chain, its
    ///                                neighborhood and its options out of range
    void require_valid() const {
        detail::require_valid(neighborhood);
        detail::require_valid(merging);
        detail::require_valid(visibility);
        if (leave_out) detail::require_valid(*leave_out);
        if constexpr (is_on_cells)
            detail::require_valid(segmentation.planes);
        else {
            detail::require_valid(segmentation.surfaces);
            segmentation.repair.require_valid();
        }
    }

    using result_type = perception_result<estimate_t<Estimator>>;  ///< what is returned

    /// Perceives n points: any point range, or an index of it; a range without view points counts
    /// as seen from the origin.
    /// @throws std::invalid_argument  for parameters of the chain, its neighborhood and its options
    ///                                out of range, before the first step; for those of the
    ///                                estimator, in the step that calls it; and if a finite point
    ///                                has a view point that is not finite
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
                spatial_index given = std::move(result.index);
                into(result, std::as_const(given), run, std::move(projection));
                if (result.kept.size() == given.size()) result.index = std::move(given);
                return;
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
template <class Neighborhood, class Estimator, class Merge = conservative,
          class Segmentation = planes_on_cells>
perception(Neighborhood, Estimator, Merge = {}, Segmentation = {},
           std::optional<noise_curve> = std::nullopt,
           std::optional<floor_and_ceiling> = std::nullopt, merge_occluded_options = {},
           visibility_options = {}) -> perception<Neighborhood, Estimator, Merge, Segmentation>;

}  // namespace gnomon
