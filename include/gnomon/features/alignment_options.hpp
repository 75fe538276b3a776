// SPDX-License-Identifier: BSL-1.0
/// @file
/// The options of `align_to_surface`.
#pragma once

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>

namespace gnomon {

/// Noise, what may move, and which points correspond.
struct alignment_options {
    /// Of the points, along their rays, or in all directions where view points are unknown.
    /// Unevenness of the surface, or of its samples, is stated as noise too: `noise.plus(0.002)`.
    noise_curve noise = constant_noise{};
    /// Of the samples of the surface, independent of each other; none for a model.
    noise_curve surface_noise = constant_noise{0.0};
    /// Of the normals of the surface: directions of the motion that only variations of this size
    /// determine are degenerate.
    angle normal_noise = degrees(1.0);
    /// Only turns about the z-axis of the surface's frame and shifts normal to it, as of an object
    /// on the ground; else all six.
    bool on_ground = false;
    bool two_sided = false;       ///< normals of the surface have no sign: nothing faces away
    double max_distance = 0.10;   ///< between corresponding points at the start [m]
    double last_distance = 0.03;  ///< the same at the end [m]: above the spacing of the samples
    angle max_angle = degrees(45.0);  ///< between the normals of corresponding points
    int max_iterations = 50;          ///< on all points, and on a sample of them before

    /// @throws std::invalid_argument  unless 0 < last_distance <= max_distance, both finite, angles
    ///                                are from 0 to 90 degrees, and there is an iteration
    void require_valid() const {
        using detail::require;
        require(max_distance > 0.0 && std::isfinite(max_distance),
                "align_to_surface: max_distance must be positive and finite");
        require(last_distance > 0.0 && last_distance <= max_distance,
                "align_to_surface: last_distance must be positive, at most max_distance");
        for (const angle a : {normal_noise, max_angle})
            require(a >= degrees(0.0) && a <= degrees(90.0),
                    "align_to_surface: an angle must be from 0 to 90 degrees");
        require(max_iterations > 0, "align_to_surface: requires an iteration");
    }
};

}  // namespace gnomon
