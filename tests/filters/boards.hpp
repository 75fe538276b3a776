// SPDX-License-Identifier: BSL-1.0
/// @file
/// Scans of boards by wide beams, for the tests of filters that depend on the width of beams.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "laws/clouds.hpp"
#include <gnomon/core/point.hpp>
#include <gnomon/core/scan.hpp>

namespace boards {

inline constexpr double beam = 0.010;     // [rad]
inline constexpr double spacing = 0.004;  // of rays [rad]

/// What wide beams from the origin return of boards that face it: the mean distance of those that a
/// beam hits, of which the nearer one hides nothing but what is behind it.
struct board {
    double distance, half_width, half_height;  // [m]
};

/// The distance at which a thin ray hits the first of these boards, or infinity.
inline double hit(const std::vector<board>& boards, double y, double z) {
    for (const board& b : boards)
        if (std::abs(y * b.distance) <= b.half_width && std::abs(z * b.distance) <= b.half_height)
            return b.distance;
    return clouds::infinity;
}

/// A raster of rays with slopes y and z, of beams that average over `width` [rad].
inline gnomon::scan scan_of(const std::vector<board>& boards, double width, int lines = 60) {
    gnomon::scan scan;
    scan.viewpoints = Eigen::Vector3d(0, 0, 0);
    for (int j = -lines; j <= lines; ++j) {
        for (int i = -60; i <= 60; ++i) {
            const double y = spacing * (i + 0.3), z = 1.5 * spacing * (j + 0.1);
            double sum = 0.0, hits = 0.0;
            for (int b = -2; b <= 2; ++b) {
                for (int a = -2; a <= 2; ++a) {
                    const double x = hit(boards, y + 0.25 * a * width, z + 0.25 * b * width);
                    if (!std::isfinite(x)) continue;
                    sum += x;
                    hits += 1.0;
                }
            }
            if (hits == 0.0) continue;
            const double x = sum / hits;
            scan.points.emplace_back(x, x * y, x * z);
        }
    }
    return scan;
}

/// The indices of all points.
inline std::vector<gnomon::point_index> all_of(const gnomon::scan& scan) {
    std::vector<gnomon::point_index> all(scan.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<gnomon::point_index>(i);
    return all;
}

/// Adds a point at the view point, and such as are not finite or too far.
inline void add_points_without_a_ray(gnomon::scan& scan) {
    for (const Eigen::Vector3d& p :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(clouds::nan, 0, 0),
          Eigen::Vector3d(0, clouds::infinity, 0), Eigen::Vector3d(1e300, 1e300, 0)})
        scan.points.push_back(p);
}

}  // namespace boards
