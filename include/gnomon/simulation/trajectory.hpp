// SPDX-License-Identifier: BSL-1.0
/// @file
/// The motion of a range finder or a spinning lidar during a scan: the `sensor_trajectory` concept
/// and its models.
///
/// A trajectory has a `duration` [s] and gives the pose of the sensor at each time from 0 to it.
/// Models: `horizontal`, `vertical`, `rotational` (Klasing 2010, Sec. 2.4.3, Fig. 2.14), `fixed`,
/// `driving`, and `along(duration, f)` for any function f of time; `joint_motion` of
/// gnomon/simulation/kinematic_chain.hpp.
#pragma once

#include <concepts>
#include <utility>

#include <Eigen/Core>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation {

/// The pose of the sensor as a function of time. Calls are const and thread-safe.
template <class T>
concept sensor_trajectory = requires(const T& trajectory, double seconds) {
    { trajectory.duration } -> std::convertible_to<double>;
    { trajectory(seconds) } -> std::same_as<pose>;
};

namespace detail {

/// The angle at a time: linear from -sweep/2 to sweep/2 over the duration.
[[nodiscard]] inline angle swept(angle sweep, double seconds, double duration) {
    return radians(sweep.radians() * (seconds / duration - 0.5));
}

}  // namespace detail

/// Yaws from right to left with vertical scan lines.
struct horizontal {
    pose mount = {};             ///< the sensor when it looks straight ahead
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(180);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * yaw(detail::swept(sweep, seconds, duration)) * roll(degrees(90));
    }
};

/// Pitches from top to bottom with horizontal scan lines.
struct vertical {
    pose mount = {};             ///< the sensor when it looks straight ahead
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(120);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * pitch(detail::swept(sweep, seconds, duration));
    }
};

/// Rolls about the optical axis, where all scan lines intersect.
struct rotational {
    pose mount = {};             ///< the sensor at half the duration
    double duration = 4.0;       ///< t_s [s]
    angle sweep = degrees(180);  ///< in all

    [[nodiscard]] pose operator()(double seconds) const {
        return mount * roll(detail::swept(sweep, seconds, duration));
    }
};

/// Does not move.
struct fixed {
    pose mount = {};        ///< at all times
    double duration = 1.0;  ///< t_s [s]

    [[nodiscard]] pose operator()(double) const { return mount; }
};

/// Drives with a constant velocity and a constant rate of turn, along a line or an arc.
struct driving {
    pose mount = {};                                             ///< the sensor at the time 0
    double duration = 0.1;                                       ///< t_s [s]
    Eigen::Vector3d velocity = Eigen::Vector3d(15.0, 0.0, 0.0);  ///< in the sensor's frame [m/s]
    angle turn_per_second = {};  ///< about the z axis of the mount, to the left

    [[nodiscard]] pose operator()(double seconds) const {
        const double half = 0.5 * seconds * turn_per_second.radians();
        // The integral of the turning velocity: in the plane of the turn the chord of the arc,
        // which points half the turn to the left and is sin(half) / half times as long as the arc.
        const double chord = seconds * (half == 0.0 ? 1.0 : std::sin(half) / half);
        const pose half_turn = yaw(radians(half));
        pose moved = half_turn * half_turn;
        moved.position = half_turn.direction_out(
            {velocity.x() * chord, velocity.y() * chord, velocity.z() * seconds});
        return mount * moved;
    }
};

/// Moves by a function of time, such as the odometry of a robot.
template <class F>
struct along {
    double duration;  ///< t_s [s]
    F pose_at;        ///< seconds -> pose

    /// @param function  the pose at a time [s]
    along(double seconds, F function) : duration(seconds), pose_at(std::move(function)) {}

    [[nodiscard]] pose operator()(double seconds) const { return pose_at(seconds); }
};

}  // namespace gnomon::simulation
