// SPDX-License-Identifier: BSL-1.0
/// @file
/// What `perception` returns.
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/perception/detail/perception_memory.hpp>
#include <gnomon/segmentation/plane_estimate.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// What was perceived in n points.
/// @tparam Estimate  what the estimator gives: estimate_t<Estimator>
template <class Estimate = plane_fit>
struct perception_result {
    /// A step and how long it took [s].
    struct timed_step {
        std::string_view name;  ///< of the step
        double seconds;         ///< of wall-clock time
    };
    /// The noise of the points, which all steps share.
    struct known_noise {
        noise_curve curve = constant_noise{0.0};  ///< along the rays, as measured or given
        /// That of wide planes: more, where neighbors have errors in common, or planes scatter by
        /// more than the given noise.
        noise_curve of_planes = constant_noise{0.0};
        /// Whether it is that across the surfaces, in place of that along the rays; then nothing
        /// was merged behind occluders.
        bool is_across_surface = false;
        std::string_view reason = {};  ///< why it is so
    };

    std::optional<plane> floor;             ///< if it was searched for and found
    std::optional<double> ceiling;          ///< its height above the floor [m]
    std::vector<point_index> kept;          ///< the points that were not removed, ascending
    spatial_index index;                    ///< of the kept points; empty if an index was
                                            ///< given and no point was removed
    known_noise noise;                      ///< by which the steps went
    std::vector<surfel<Estimate>> surface;  ///< n; without a normal where removed
    segments initial_segments;              ///< of the n points, before merging behind occluders
    segments surfaces;                      ///< of the n points, after all steps
    std::vector<plane_estimate> planes;     ///< of the surfaces; which of them are flat
    std::vector<considered_gap> gaps;       ///< all that the merging considered
    std::vector<timed_step> steps;          ///< in their order
    detail::perception_memory<Estimate> memory = {};  ///< reused by the next call

    /// The duration of all steps [s].
    [[nodiscard]] double seconds() const {
        double sum = 0.0;
        for (const timed_step& step : steps) sum += step.seconds;
        return sum;
    }
};

}  // namespace gnomon
