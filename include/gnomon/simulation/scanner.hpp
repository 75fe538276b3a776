// SPDX-License-Identifier: BSL-1.0
/// @file
/// A 2D laser range finder. A scan line is a fan of beams in the x-y plane of the sensor; x is the
/// optical axis.
///
/// Klasing 2010, Sec. 2.4.3: a scan of t_s seconds has n = t_s f_s alpha_FoV / alpha_r beams.
#pragma once

#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/detail/line_scanner.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation {

/// A 2D laser range finder. The default is the scanner of the thesis: a UTM-30LX, restricted to 180
/// degrees.
struct scanner {
    angle field_of_view = degrees(180);  ///< alpha_FoV, about the optical axis
    angle resolution = degrees(0.25);    ///< alpha_r, between beams
    double frequency = 40.0;             ///< f_s, scan lines per second [Hz]
    double min_range = 0.1;              ///< nearer surfaces give no reading [m]
    double max_range = 30.0;             ///< farther surfaces give no reading [m]

    /// The number of beams of a scan line. Precondition: the scanner is valid.
    [[nodiscard]] std::size_t beams() const {
        return detail::whole(field_of_view.radians() / resolution.radians());
    }

    /// The number of scan lines in `seconds`. Precondition: fewer than 2^53.
    [[nodiscard]] std::size_t lines(double seconds) const {
        return detail::whole(seconds * frequency);
    }

    /// Scan lines per second [Hz].
    [[nodiscard]] double line_rate() const { return frequency; }

    /// The frame of a scan line in the sensor's frame: all lie in its x-y plane.
    [[nodiscard]] pose line_pose(std::size_t) const { return {}; }

    /// The direction of beam j in the sensor's frame, from right to left and symmetric about the
    /// optical axis. The field of view is divided into sectors of the width `resolution` with a
    /// beam in the middle of each; a remainder is split between both ends.
    [[nodiscard]] Eigen::Vector3d direction(std::size_t j) const {
        const double from_middle =
            static_cast<double>(j) + 0.5 - 0.5 * static_cast<double>(beams());
        const angle a = radians(from_middle * resolution.radians());
        return {cos(a), sin(a), 0.0};
    }

    /// @throws std::invalid_argument  unless 0 < resolution <= field of view <= 360 degrees, with
    ///                                at most 10,000,000 beams, the frequency is positive and
    ///                                finite, and 0 <= min_range < max_range, which is finite
    void require_valid() const {
        using gnomon::detail::require;
        require(
            resolution > radians(0) && resolution <= field_of_view && field_of_view <= degrees(360),
            "scanner: needs 0 < resolution <= field of view <= 360 degrees");
        require(field_of_view.radians() / resolution.radians() < 1e7,
                "scanner: the resolution must leave 10,000,000 beams at most");
        require(frequency > 0.0 && std::isfinite(frequency),
                "scanner: the frequency must be positive and finite");
        require(min_range >= 0.0 && min_range < max_range && std::isfinite(max_range),
                "scanner: needs 0 <= min_range < max_range, finite");
    }
};

/// The range finders of the thesis, with the figures of their data sheets. The data sheets give
/// these standard deviations for bright surfaces: 5 mm (LMS-200), 3 to 10 mm (LMS-400), 1 % of the
/// range or 10 mm (URG-04LX), 10 to 30 mm (UTM-30LX). They are set in the beam.
namespace scanners {

/// SICK LMS-200 at half a degree.
[[nodiscard]] inline scanner sick_lms_200() {
    return {.field_of_view = degrees(180),
            .resolution = degrees(0.5),
            .frequency = 37.5,
            .min_range = 0.0,
            .max_range = 80.0};
}

/// SICK LMS-400 at a quarter of a degree.
[[nodiscard]] inline scanner sick_lms_400() {
    return {.field_of_view = degrees(70),
            .resolution = degrees(0.25),
            .frequency = 360.0,
            .min_range = 0.7,
            .max_range = 3.0};
}

/// Hokuyo URG-04LX: 1,024 steps per revolution.
[[nodiscard]] inline scanner hokuyo_urg_04lx() {
    return {.field_of_view = degrees(240),
            .resolution = degrees(360.0 / 1024.0),
            .frequency = 10.0,
            .min_range = 0.06,
            .max_range = 4.095};
}

/// Hokuyo UTM-30LX.
[[nodiscard]] inline scanner hokuyo_utm_30lx() {
    return {.field_of_view = degrees(270),
            .resolution = degrees(0.25),
            .frequency = 40.0,
            .min_range = 0.1,
            .max_range = 30.0};
}

}  // namespace scanners

/// The three densities of Fig. 2.16: 7,200, 28,800 and 115,200 points in 4 seconds.
namespace densities {

/// 7,200 points.
[[nodiscard]] inline scanner low() { return {.resolution = degrees(1.0), .frequency = 10.0}; }
/// 28,800 points.
[[nodiscard]] inline scanner medium() { return {.resolution = degrees(0.5), .frequency = 20.0}; }
[[nodiscard]] inline scanner high() { return {}; }  ///< 115,200 points

}  // namespace densities

}  // namespace gnomon::simulation
