// SPDX-License-Identifier: BSL-1.0
/// @file
/// A range scan as files give it: points, from where they were seen, and whatever other columns the
/// caller asked for. For users who have no container of their own; every algorithm takes a
/// `scan` as it takes any other `point_range`.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/viewpoints.hpp>

namespace gnomon {

/// One number per point beside its position: an intensity, a label, a component of a true normal.
struct scalar_field {
    std::string name;
    std::vector<double> values;
};

/// Points with view points; models `point_range` and `has_viewpoints`.
struct scan {
    std::vector<Eigen::Vector3d> points;  ///< [m]; may contain NaN, as sensors do
    viewpoint_table viewpoints;
    std::vector<scalar_field> fields;  ///< each as long as `points`

    [[nodiscard]] auto begin() const { return points.begin(); }
    [[nodiscard]] auto end() const { return points.end(); }
    [[nodiscard]] std::size_t size() const { return points.size(); }
};

}  // namespace gnomon
