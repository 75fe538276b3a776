// SPDX-License-Identifier: BSL-1.0
/// @file
/// Verifies a hypothesis, an object at a pose, against a scan: which of the surface that the sensor
/// should see is there, where it saw through, and which points the object does not explain.
///
///     namespace rec = gnomon::recognition;
///     const gnomon::spatial_index index(scan);
///     const gnomon::visibility seen(scan, {.noise = noise});
///     const rec::verification v =
///         rec::verify_pose(index, surface, seen, chair, pose, {.noise = noise});
///     if (v.support() > 0.8 && v.explanation() > 0.7) use(pose);
///
/// Points at silhouettes, which wide beams have, are neither surface nor free space: they are
/// removed from the index first, by remove_silhouettes(), but not from the visibility.
///
/// In no umbrella: include it by name.
#pragma once

#include <cstddef>
#include <functional>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/normal_range.hpp>
#include <gnomon/core/rigid_motion.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/occlusion/visibility.hpp>
#include <gnomon/recognition/detail/pose_verifier.hpp>
#include <gnomon/recognition/surface_model.hpp>
#include <gnomon/recognition/verification.hpp>

namespace gnomon::recognition {

/// Verifies an object at a pose.
///
/// A sample of the object's surface that faces a view point is supported if a point of the scan
/// lies in its plane, as far from it as rays are apart at most, with a compatible normal. The
/// others are compared with the ranges observed in the pixel of the sample and the eight around it.
/// @param index    of the scan's points, without the floor or with it
/// @param surface  surface elements of these points; missing normals are compatible with all
/// @param seen     the observations of the same scan, floor and walls included
/// @param model    the object
/// @param pose     of the object's frame in that of the scan
/// @return counts; see `verification`
/// @throws std::invalid_argument  if points and normals differ in number, the pose is no rigid
///                                motion, or the options are not valid
/// Complexity: O(s (log n + w) + p log m) for s samples and p points, at most `most` of the options
/// each, and w walls, from each view point.
template <normal_range Surface>
[[nodiscard]] verification verify_pose(const spatial_index& index, const Surface& surface,
                                       const visibility& seen, const surface_model& model,
                                       const rigid_motion& pose,
                                       const verification_options& options = {}) {
    gnomon::detail::require(static_cast<std::size_t>(std::ranges::size(surface)) == index.size(),
                            "verify_pose: points and normals differ in number");
    return detail::pose_verifier(index, seen, model, pose, options)(
        [&](point_index i) -> Eigen::Vector3d { return surface[i].normal; }, detail::all_points);
}

/// Verifies an object at a pose in a scan without normals. Parameters, result and errors are as
/// above.
[[nodiscard]] inline verification verify_pose(const spatial_index& index, const visibility& seen,
                                              const surface_model& model, const rigid_motion& pose,
                                              const verification_options& options = {}) {
    return detail::pose_verifier(index, seen, model, pose, options)(
        [](point_index) { return Eigen::Vector3d(0.0, 0.0, 0.0); }, detail::all_points);
}

}  // namespace gnomon::recognition
