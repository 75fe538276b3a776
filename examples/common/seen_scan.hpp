// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where did the sensor stand? A scan in which something was measured, with view points.
#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include <Eigen/Core>

#include <gnomon/core.hpp>

/// The scan with this view point; without one, with its own, or the origin.
/// @throws gnomon::error  if no point of it is finite
inline gnomon::scan seen_scan(gnomon::scan scan, const std::string& name,
                              const std::optional<Eigen::Vector3d>& viewpoint) {
    if (std::ranges::none_of(scan, gnomon::is_finite))
        throw gnomon::error(name, "", "has no finite point");
    if (viewpoint)
        scan.viewpoints = *viewpoint;
    else if (scan.viewpoints.empty())
        scan.viewpoints = Eigen::Vector3d(0.0, 0.0, 0.0);
    return scan;
}
