// SPDX-License-Identifier: BSL-1.0
/// @file
/// Where does a segment end? Its box, and the outline of a flat one with its holes.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <Eigen/Core>

#include <gnomon/features/alpha_shape.hpp>
#include <gnomon/features/convex_polygon.hpp>
#include <gnomon/features/minimum_area_rectangle.hpp>
#include <gnomon/features/minimum_volume_box.hpp>
#include <gnomon/gnomon.hpp>

/// The shape of a segment of a scan.
struct segment_shape {
    /// Of a flat segment the rectangle of smallest area in its plane, as thick as the rms distance
    /// of its points from the plane; else the box of smallest volume.
    gnomon::oriented_box box;
    gnomon::alpha_shape outline;  ///< of a flat segment; indices of points of the scan
};

/// A path of points, projected to a plane.
[[nodiscard]] inline std::vector<Eigen::Vector3d> on_plane(
    const gnomon::scan& scan, const gnomon::plane& plane,
    std::span<const gnomon::point_index> path) {
    std::vector<Eigen::Vector3d> corners;
    for (const gnomon::point_index i : path)
        corners.push_back(scan.points[i] - plane.signed_distance(scan.points[i]) * plane.normal);
    return corners;
}

/// The root mean square of the distances of the finite ones of some points from a plane.
[[nodiscard]] inline double rms_distance(const gnomon::scan& scan,
                                         std::span<const gnomon::point_index> members,
                                         const gnomon::plane& plane) {
    double sum = 0.0;
    double count = 0.0;
    for (const gnomon::point_index i : members) {
        if (!gnomon::is_finite(scan.points[i])) continue;
        const double distance = plane.signed_distance(scan.points[i]);
        sum += distance * distance;
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

[[nodiscard]] inline segment_shape shape_of(const gnomon::scan& scan,
                                            std::span<const gnomon::point_index> members,
                                            const gnomon::plane_estimate& estimate) {
    const gnomon::subset_view points(scan, members);
    if (!estimate.is_flat) return {gnomon::minimum_volume_box(points), {}};
    segment_shape shape{
        gnomon::minimum_area_rectangle(gnomon::convex_polygon::of(points, estimate.plane)),
        gnomon::alpha_shape::of(points, estimate.plane)};
    shape.box.lengths[2] = rms_distance(scan, members, estimate.plane);
    const auto index_in_scan = [&](gnomon::point_index& i) { i = members[i]; };
    for (auto& polygon : shape.outline.polygons) {
        for (auto& i : polygon.outline) index_in_scan(i);
        for (auto& hole : polygon.holes)
            for (auto& i : hole) index_in_scan(i);
    }
    for (auto& triangle : shape.outline.triangles)
        for (auto& i : triangle) index_in_scan(i);
    return shape;
}

/// The shapes of all segments.
[[nodiscard]] inline std::vector<segment_shape> shapes_of(
    const gnomon::scan& scan, const gnomon::segments& parts,
    const std::vector<gnomon::plane_estimate>& planes, const gnomon::threads& threads) {
    std::vector<segment_shape> shapes(parts.size());
    threads(parts.size(), [&](std::size_t label) {
        shapes[label] = shape_of(scan, parts[label], planes[label]);
    });
    return shapes;
}

/// The covariance of a plane with its turns about two other axes in it.
[[nodiscard]] inline Eigen::Matrix3d covariance_about(const Eigen::Matrix3d& axes,
                                                      const gnomon::plane_estimate& estimate) {
    const Eigen::Matrix3d turn = axes.transpose() * estimate.axes;
    return turn * estimate.covariance * turn.transpose();
}
