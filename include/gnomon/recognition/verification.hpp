// SPDX-License-Identifier: BSL-1.0
/// @file
/// What a scan shows of an object at a pose: the result and the options of `verify_pose`.
#pragma once

#include <cstddef>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/core/noise_curve.hpp>
#include <gnomon/core/oriented_box.hpp>
#include <gnomon/core/plane.hpp>
#include <gnomon/recognition/wall.hpp>

namespace gnomon::recognition {

/// Tolerances of a verification.
struct verification_options {
    noise_curve noise = constant_noise{};  ///< along the rays; three deviations are no difference
    /// Between surface and points, beyond noise: errors of the pose and of the model [m]; chosen
    /// on simulated rooms, seeds 1 to 3.
    double tolerance = 0.01;
    angle max_angle = degrees(45.0);  ///< between the normals of a sample and of a point
    /// Points lower in the object's frame are floor, and explained by nothing [m].
    double lowest = 0.05;
    /// Points up to this much farther from the surface than those on it are next to it [m]; chosen
    /// on simulated rooms, seeds 1 to 60.
    double around = 0.04;
    std::vector<wall> walls{};  ///< in which no object stands, such as those of perceived_views
    std::size_t most = 1000;  ///< samples, and points, that are tested; of more, evenly chosen ones

    /// @throws std::invalid_argument  unless the tolerance is positive and finite, the angle from 0
    ///                                to 90 degrees, `lowest` a number, `around` finite and not
    ///                                negative, walls are planes and boxes, and something is
    ///                                tested
    void require_valid() const {
        using gnomon::detail::require;
        require(tolerance > 0.0 && std::isfinite(tolerance),
                "verify_pose: the tolerance must be positive and finite");
        require(max_angle >= degrees(0.0) && max_angle <= degrees(90.0),
                "verify_pose: an angle must be from 0 to 90 degrees");
        require(!std::isnan(lowest), "verify_pose: the lowest height is NaN");
        require(around >= 0.0 && std::isfinite(around),
                "verify_pose: `around` must be finite and not negative");
        require(most > 0, "verify_pose: requires a sample");
        for (const wall& w : walls) {
            gnomon::detail::require_hesse(w.surface);
            gnomon::detail::require_valid(w.extent);
        }
    }
};

/// Numbers of samples of an object's surface, by the observations of them, and of points.
struct verification {
    std::size_t samples = 0;       ///< tested
    std::size_t facing = 0;        ///< of these, towards a view point: the sum of the next six
    std::size_t supported = 0;     ///< a point of the scan is on the surface there
    std::size_t seen_through = 0;  ///< the sensor observed something clearly farther: free space
    std::size_t mismatched = 0;    ///< something at this range, but not on this surface
    /// Something nearer, and behind a wall to whose front the object reaches: it would stand in it.
    std::size_t in_walls = 0;
    std::size_t hidden = 0;      ///< something nearer otherwise
    std::size_t unobserved = 0;  ///< nothing, or nearer and farther things: an edge

    std::size_t points = 0;        ///< of the scan, tested: those within the bounds of the object
    std::size_t explained = 0;     ///< of these, on the surface
    std::size_t near_surface = 0;  ///< of the scan, tested: those on the surface or next to it
    std::size_t on_surface = 0;    ///< of these, on it

    /// Samples at places where no surface of an object can be.
    [[nodiscard]] std::size_t refuted() const { return seen_through + in_walls; }
    /// The share of supported samples in those that are not hidden or unobserved; 0 without any.
    [[nodiscard]] double support() const {
        return share(supported, supported + mismatched + refuted());
    }
    /// The share of explained points; 0 without any.
    [[nodiscard]] double explanation() const { return share(explained, points); }
    /// The share of the points near the surface that are on it; 0 without any. It is small where
    /// surfaces of the scan go on beyond the object, which is a part of something larger.
    [[nodiscard]] double containment() const { return share(on_surface, near_surface); }
    /// The share of facing samples that were observed: not hidden, in walls or unobserved; 0
    /// without any.
    [[nodiscard]] double observed() const {
        return share(supported + seen_through + mismatched, facing);
    }

  private:
    [[nodiscard]] static double share(std::size_t part, std::size_t of) {
        return of == 0 ? 0.0 : static_cast<double>(part) / static_cast<double>(of);
    }
};

}  // namespace gnomon::recognition
