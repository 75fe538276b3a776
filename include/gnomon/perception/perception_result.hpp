// SPDX-License-Identifier: BSL-1.0
/// @file
/// What `perception` returns.
#pragma once

#include <optional>
#include <vector>

#include <gnomon/core/plane.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/plane_fit.hpp>
#include <gnomon/normals/surfel.hpp>
#include <gnomon/occlusion/merge_occluded.hpp>
#include <gnomon/perception/detail/perception_memory.hpp>
#include <gnomon/segmentation/segments.hpp>

namespace gnomon {

/// What was perceived in n points.
/// @tparam Estimate  what the estimator gives: estimate_t<Estimator>
template <class Estimate = plane_fit>
struct perception_result {
    /// How long the steps took [s].
    struct durations {
        double preprocessing = 0.0;  ///< finding floor and ceiling
        double index = 0.0;          ///< building it
        double normals = 0.0;        ///< with their repair and orientation
        double segmentation = 0.0;
        double merging = 0.0;     ///< with range images
        double assignment = 0.0;  ///< splitting of outliers, assignment of unlabeled points,
                                  ///< joining of surfaces of revolution
    };

    std::optional<plane> floor;             ///< if it was searched for and found
    std::optional<double> ceiling;          ///< its height above the floor [m]
    std::vector<point_index> kept;          ///< the points that were not removed, ascending
    spatial_index index;                    ///< of the kept points; empty if an index was
                                            ///< given and no point was removed
    std::vector<surfel<Estimate>> surface;  ///< n; without a normal where removed
    segments initial_segments;              ///< of the n points, before merging
    segments surfaces;                      ///< of the n points, after all steps
    std::vector<considered_gap> gaps;       ///< all that the first merging considered, and what
                                            ///< the second one merged
    durations seconds;
    detail::perception_memory<Estimate> memory = {};  ///< reused by the next call
};

}  // namespace gnomon
