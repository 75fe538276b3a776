// SPDX-License-Identifier: BSL-1.0
/// @file
/// A simulated scan and what is true of it, point by point.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/scan.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon {

/// Each list is as long as the scan. A point that is no echo of a surface (clutter, or a reading
/// that failed) has the normal 0, the numbers `nothing` and a true range of NaN. Of a beam with a
/// footprint the truth is that of the surface which most of the echo came from: where the axis of
/// the beam meets it or, if it passes beside, at the nearest place that the beam touches.
struct true_scan {
    gnomon::scan scan;                        ///< points with view points
    std::vector<Eigen::Vector3d> normals;     ///< unit length, towards the view point
    std::vector<std::int32_t> surfaces;       ///< numbers of the scene
    std::vector<std::int32_t> parts;          ///< numbers of the scene
    std::vector<std::int32_t> objects;        ///< numbers of the scene
    std::vector<double> ranges;               ///< true ones, along the directions [m]
    std::vector<Eigen::Vector3d> directions;  ///< of the rays, unit length
    std::vector<echo> echoes;                 ///< what became of the reading
};

}  // namespace gnomon
