// SPDX-License-Identifier: BSL-1.0
/// @file
/// An axis-aligned bounding box.
#pragma once

#include <algorithm>
#include <limits>

#include <Eigen/Core>

namespace gnomon::simulation {

/// An axis-aligned bounding box. It is empty if a low coordinate exceeds the high one, as in a
/// default-constructed box.
struct bounds {
    /// [m]
    Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
    /// [m]
    Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

    /// Halfway between the corners [m]. Precondition: not empty.
    [[nodiscard]] Eigen::Vector3d middle() const {
        return {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0.5 * (low.z() + high.z())};
    }

    /// Length, width and height [m]. Precondition: not empty.
    [[nodiscard]] Eigen::Vector3d size() const {
        return {high.x() - low.x(), high.y() - low.y(), high.z() - low.z()};
    }

    /// Widens to hold a point.
    void extend(const Eigen::Vector3d& p) { extend(bounds{p, p}); }

    /// Widens to hold other bounds.
    void extend(const bounds& other) {
        for (int a = 0; a < 3; ++a) {
            low[a] = std::min(low[a], other.low[a]);
            high[a] = std::max(high[a], other.high[a]);
        }
    }
};

}  // namespace gnomon::simulation
