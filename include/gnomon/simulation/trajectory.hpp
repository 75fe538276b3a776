// SPDX-License-Identifier: BSL-1.0
/// @file
/// How the range finder is moved to see in three dimensions: the `sensor_trajectory` concept, and
/// the three trajectories that are common.
///
/// A trajectory lasts `duration` seconds and tells the pose of the sensor at each time between.
/// Models: `horizontal`, `vertical`, `rotational`, `fixed`, and `along(duration, f)` for any
/// function f of the time. Klasing 2010, Sec. 2.4.3, Fig. 2.14.
#pragma once

#include <concepts>
#include <utility>

#include <gnomon/core/angle.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon {

/// Const and thread-safe.
template <class T>
concept sensor_trajectory = requires(const T& trajectory, double seconds) {
    { trajectory.duration } -> std::convertible_to<double>;
    { trajectory(seconds) } -> std::same_as<pose>;
};

namespace detail {

/// From -sweep/2 to sweep/2 in the given time.
[[nodiscard]] inline angle swept(angle sweep, double seconds, double duration) {
    return radians(sweep.radians() * (seconds / duration - 0.5));
}

}  // namespace detail

/// Yaws from right to left, the scan lines being upright.
struct horizontal {
    pose mount = {};             ///< the sensor when it looks straight ahead
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(180);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * yaw(detail::swept(sweep, seconds, duration)) * roll(degrees(90));
    }
};

/// Pitches from top to bottom, the scan lines being level.
struct vertical {
    pose mount = {};             ///< the sensor when it looks straight ahead
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(120);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * pitch(detail::swept(sweep, seconds, duration));
    }
};

/// Rolls about the axis of sight: all scan lines cross there.
struct rotational {
    pose mount = {};             ///< the sensor half way
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(180);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * roll(detail::swept(sweep, seconds, duration));
    }
};

/// Stands still.
struct fixed {
    pose mount = {};
    double duration = 1.0;  ///< t_s [s]

    [[nodiscard]] pose operator()(double) const { return mount; }
};

/// Moves as a function of the time says: a robot that drives while it scans, a kinematic chain.
template <class F>
struct along {
    double duration;  ///< t_s [s]
    F pose_at;        ///< seconds -> pose

    along(double seconds, F function) : duration(seconds), pose_at(std::move(function)) {}

    [[nodiscard]] pose operator()(double seconds) const { return pose_at(seconds); }
};

}  // namespace gnomon
