// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where does a segment end? Its box, and the outline of a flat one with its holes.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/features/alpha_shape.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/minimum_volume_box.hpp>
#include <gnomon/features/project_to_plane.hpp>
#include <gnomon/gnomon.hpp>

/// The bounds of a segment of a scan.
struct segment_bounds {
    /// Of a flat segment the rectangle of smallest area in its plane, as thick as the rms distance
    /// of its points from the plane; else the box of smallest volume.
    gnomon::oriented_box box;
    std::vector<Eigen::Vector3d> on_plane;  ///< the points of a flat segment, moved to its plane
    gnomon::alpha_shape outline;            ///< of a flat segment; indices of these

    /// The corners of a path of the outline.
    [[nodiscard]] std::vector<Eigen::Vector3d> corners(
        std::span<const gnomon::point_index> path) const {
        std::vector<Eigen::Vector3d> corners;
        for (const gnomon::point_index i : path) corners.push_back(on_plane[i]);
        return corners;
    }
};

/// The root mean square of the distances of the finite points from a plane.
[[nodiscard]] inline double rms_distance(const auto& points, const gnomon::plane& plane) {
    double sum = 0.0;
    double count = 0.0;
    for (const Eigen::Vector3d& p : points) {
        if (!gnomon::is_finite(p)) continue;
        const double distance = plane.signed_distance(p);
        sum += distance * distance;
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

/// @param is_seen  whether noise is along the rays; else points are projected along the normal
[[nodiscard]] inline segment_bounds bounds_of(const gnomon::scan& scan,
                                              std::span<const gnomon::point_index> members,
                                              const gnomon::plane_estimate& estimate,
                                              bool is_seen) {
    const gnomon::subset_view seen(scan, members);
    if (!estimate.is_flat) return {gnomon::minimum_volume_box(seen), {}, {}};
    const gnomon::plane& plane = estimate.plane;
    segment_bounds bounds;
    bounds.on_plane = is_seen ? gnomon::project_to_plane(seen, plane)
                              : gnomon::project_to_plane(
                                    std::vector<Eigen::Vector3d>(seen.begin(), seen.end()), plane);
    const auto hull = gnomon::convex_polygon::of(bounds.on_plane, plane);
    bounds.box = gnomon::minimum_area_rectangle(hull);
    bounds.box.lengths[2] = rms_distance(seen, plane);
    bounds.outline = gnomon::alpha_shape::of(bounds.on_plane, plane);
    return bounds;
}

/// The bounds of all segments.
template <class Estimate>
[[nodiscard]] std::vector<segment_bounds> bounds_of(const gnomon::scan& scan,
                                                    const gnomon::perception_result<Estimate>& r,
                                                    const gnomon::threads& threads) {
    std::vector<segment_bounds> bounds(r.surfaces.size());
    threads(bounds.size(), [&](std::size_t label) {
        bounds[label] =
            bounds_of(scan, r.surfaces[label], r.planes[label], !r.noise.is_across_surface);
    });
    return bounds;
}

/// The covariance of a plane with its turns about two other axes in it.
[[nodiscard]] inline Eigen::Matrix3d covariance_about(const Eigen::Matrix3d& axes,
                                                      const gnomon::plane_estimate& estimate) {
    const Eigen::Matrix3d turn = axes.transpose() * estimate.axes;
    return turn * estimate.covariance * turn.transpose();
}
