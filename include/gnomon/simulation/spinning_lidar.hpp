// SPDX-License-Identifier: BSL-1.0
/// @file
/// A spinning multi-beam lidar: beams of fixed elevations turn about the z axis of the sensor and
/// fire all at once, column by column. x is the forward direction, z the axis of rotation.
///
/// A sweep begins behind the sensor and turns clockwise, seen from above, so that the seam between
/// two sweeps of a moving sensor lies behind it. Real instruments fire the beams of a column one
/// after the other, within 46 to 55 microseconds; this is not modelled.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/detail/line_scanner.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation {

namespace detail {

/// Appends `count` elevations, from `highest` downwards in equal steps [deg].
inline void append_elevations(std::vector<angle>& all, std::size_t count, double highest,
                              double step) {
    for (std::size_t i = 0; i < count; ++i)
        all.push_back(degrees(highest - step * static_cast<double>(i)));
}

/// 16 beams, 15 to -15 degrees.
[[nodiscard]] inline std::vector<angle> sixteen_elevations() {
    std::vector<angle> all;
    append_elevations(all, 16, 15.0, 2.0);
    return all;
}

}  // namespace detail

/// A spinning multi-beam lidar. The default is a Velodyne VLP-16 at 10 Hz.
struct spinning_lidar {
    /// Of the beams, above the plane of rotation, in the order of the beams of a column.
    std::vector<angle> elevations = detail::sixteen_elevations();
    std::size_t columns = 1'808;  ///< per revolution
    double frequency = 10.0;      ///< revolutions per second [Hz]
    double min_range = 0.4;       ///< nearer surfaces give no reading [m]
    double max_range = 100.0;     ///< farther surfaces give no reading [m]

    /// The number of beams of a column.
    [[nodiscard]] std::size_t beams() const { return elevations.size(); }

    /// The duration of one revolution [s].
    [[nodiscard]] double revolution() const { return 1.0 / frequency; }

    /// Columns per second [Hz].
    [[nodiscard]] double line_rate() const { return frequency * static_cast<double>(columns); }

    /// The number of columns in `seconds`. Precondition: fewer than 2^53.
    [[nodiscard]] std::size_t lines(double seconds) const {
        return detail::whole(seconds * line_rate());
    }

    /// The frame of a column in the sensor's frame. A revolution is divided into sectors, with a
    /// column in the middle of each.
    [[nodiscard]] pose line_pose(std::size_t column) const {
        const double turned =
            (static_cast<double>(column % columns) + 0.5) / static_cast<double>(columns);
        return yaw(radians(std::numbers::pi * (1.0 - 2.0 * turned)));
    }

    /// The direction of beam j in the frame of its column, of unit length; it is the direction in
    /// the sensor's frame while the column looks forward.
    [[nodiscard]] Eigen::Vector3d direction(std::size_t j) const {
        return {cos(elevations[j]), 0.0, sin(elevations[j])};
    }

    /// @throws std::invalid_argument  unless there are 1 to 10,000 beams with elevations between
    ///                                -90 and 90 degrees, 1 to 10,000,000 columns, the frequency is
    ///                                positive and finite, and 0 <= min_range < max_range, which is
    ///                                finite
    void require_valid() const {
        using gnomon::detail::require;
        require(!elevations.empty() && elevations.size() <= 10'000,
                "spinning_lidar: needs 1 to 10,000 beams");
        require(std::all_of(elevations.begin(), elevations.end(),
                            [](angle e) { return e > degrees(-90) && e < degrees(90); }),
                "spinning_lidar: elevations must be between -90 and 90 degrees");
        require(columns >= 1 && columns <= 10'000'000,
                "spinning_lidar: needs 1 to 10,000,000 columns");
        require(frequency > 0.0 && std::isfinite(line_rate()),
                "spinning_lidar: the frequency must be positive, and that of columns finite");
        require(min_range >= 0.0 && min_range < max_range && std::isfinite(max_range),
                "spinning_lidar: needs 0 <= min_range < max_range, finite");
    }
};

/// Spinning lidars of Velodyne, with the elevations, the times between two columns and the maximum
/// ranges of their user manuals. The minimum ranges of the VLP-16 and the HDL-64E are those of
/// ROS's driver. The manuals give standard deviations of 30 mm (VLP-16), 20 mm (HDL-32E) and less
/// than 20 mm (HDL-64E). They are set in the beam.
namespace scanners {

/// Velodyne VLP-16 at 10 Hz: 16 beams in steps of 2 degrees, a column each 55.296 microseconds.
[[nodiscard]] inline spinning_lidar velodyne_vlp_16() { return {}; }

/// Velodyne HDL-32E at 20 Hz: 32 beams in steps of 4/3 of a degree, a column each 46.08
/// microseconds.
[[nodiscard]] inline spinning_lidar velodyne_hdl_32e() {
    spinning_lidar result{.elevations = {}, .columns = 1'085, .frequency = 20.0, .min_range = 0.05};
    detail::append_elevations(result.elevations, 32, 32.0 / 3.0, 4.0 / 3.0);
    return result;
}

/// Velodyne HDL-64E at 10 Hz: 32 beams in steps of 1/3 of a degree above 32 beams in steps of half
/// a degree; 1.333 million readings per second.
[[nodiscard]] inline spinning_lidar velodyne_hdl_64e() {
    spinning_lidar result{.elevations = {}, .columns = 2'083, .min_range = 0.9, .max_range = 120.0};
    detail::append_elevations(result.elevations, 32, 2.0, 1.0 / 3.0);
    detail::append_elevations(result.elevations, 32, -53.0 / 6.0, 0.5);
    return result;
}

}  // namespace scanners

}  // namespace gnomon::simulation
