// SPDX-License-Identifier: BSL-1.0
/// @file
/// A simulated scan with ground truth for each point.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/scan.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/scene.hpp>

namespace gnomon::simulation {

/// A simulated scan with ground truth; each list is as long as the scan. A point without a surface
/// (clutter, or a failed reading) has the normal 0, the numbers `nothing` and a true range of NaN.
/// For a beam with a footprint the truth is that of the surface that reflected the most energy, at
/// its intersection with the beam's axis or, if the axis misses it, with the sub-ray nearest to the
/// axis.
struct true_scan {
    gnomon::scan scan;                        ///< points with view points
    std::vector<Eigen::Vector3d> normals;     ///< unit length, towards the view point
    std::vector<std::int32_t> surfaces;       ///< numbers of the scene
    std::vector<std::int32_t> parts;          ///< numbers of the scene
    std::vector<std::int32_t> objects;        ///< numbers of the scene
    std::vector<double> ranges;               ///< true ones, along the directions [m]
    std::vector<Eigen::Vector3d> directions;  ///< of the rays, unit length
    std::vector<echo> echoes;                 ///< origins of the readings
};

}  // namespace gnomon::simulation
