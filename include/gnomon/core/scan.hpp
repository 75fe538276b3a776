// SPDX-License-Identifier: BSL-1.0
/// @file
/// A range scan: points, their viewpoints, and scalar fields. The readers in gnomon/io return it.
/// Every algorithm takes a `scan` as it takes any other `point_range`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

/// Points with viewpoints and scalar fields; models `point_range` and `has_viewpoints`.
struct scan {
    /// The type of the numbers of a field in a file.
    enum class field_type : char { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

    /// One named number per point: an intensity, a label, a component of a color or of a true
    /// normal. Doubles hold the numbers of all these types exactly; 64-bit integers of PCD files
    /// become float64, exact up to 2^53.
    struct scalar_field {
        std::string name;                       ///< as in the file
        std::vector<double> values;             ///< in the order of the points
        field_type type = field_type::float64;  ///< as in the file
    };

    std::vector<Eigen::Vector3d> points;  ///< positions [m]; NaN where the sensor had no return
    viewpoint_table viewpoints;           ///< empty if unknown: the origin
    std::vector<scalar_field> fields;     ///< each as long as `points`
    /// The width [pixels] of an organized image, whose points are its pixels, row by row; else 0.
    /// Code that removes points sets it to 0.
    std::size_t width = 0;

    [[nodiscard]] auto begin() const { return points.begin(); }
    [[nodiscard]] auto end() const { return points.end(); }
    [[nodiscard]] std::size_t size() const { return points.size(); }
};

}  // namespace gnomon
