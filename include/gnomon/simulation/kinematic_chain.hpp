// SPDX-License-Identifier: BSL-1.0
/// @file
/// A kinematic chain that carries a sensor, such as a robot arm or a robot that turns in place.
/// The pose of the sensor follows from the values of the joints alone, by the convention of Denavit
/// and Hartenberg (1955): each joint has a frame with four parameters, and the chain is the product
/// of the frames.
///
/// Klasing 2010, Sec. 2.5, Fig. 2.17: an arm with seven joints and a UTM-30LX as its end effector;
/// a robot that turns in place below a vertically mounted LMS-400.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <gnomon/core/angle.hpp>
#include <gnomon/core/error.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation {

/// What the value of a joint changes.
enum class joint_kind : char {
    revolute,  ///< the angle theta, by a value in [rad]
    prismatic  ///< the offset d, by a value in [m]
};

/// A joint in the standard convention of Denavit and Hartenberg: a rotation by theta about the z
/// axis of the frame before it, a translation by d along this axis, a translation by a along the
/// new x axis, and a rotation by alpha about this axis.
struct chain_joint {
    angle theta = {};                        ///< about the old z axis, at the value 0
    double d = 0.0;                          ///< along the old z axis, at the value 0 [m]
    double a = 0.0;                          ///< along the new x axis [m]
    angle alpha = {};                        ///< about the new x axis
    joint_kind kind = joint_kind::revolute;  ///< how it moves

    /// The pose of the frame behind the joint in the frame before it.
    /// @param value  added to theta [rad] or d [m]
    [[nodiscard]] pose operator()(double value) const {
        const bool turns = kind == joint_kind::revolute;
        return yaw(radians(theta.radians() + (turns ? value : 0.0))) *
               at(a, 0.0, d + (turns ? 0.0 : value)) * roll(alpha);
    }
};

/// Joints one after the other, between a base in the scene and a sensor.
struct kinematic_chain {
    pose base = {};                        ///< the frame before the first joint
    std::vector<chain_joint> joints = {};  ///< from the base to the sensor
    pose tool = {};                        ///< the sensor in the frame behind the last joint

    /// Forward kinematics: the pose of the sensor. O(joints).
    /// @param values  one per joint [rad] or [m]
    /// @throws std::invalid_argument  if there is another number of values than of joints
    [[nodiscard]] pose operator()(std::span<const double> values) const {
        gnomon::detail::require(values.size() == joints.size(),
                                "kinematic_chain: needs one value per joint");
        pose result = base;
        for (std::size_t i = 0; i < joints.size(); ++i) result = result * joints[i](values[i]);
        return result * tool;
    }
};

/// A motion of all joints at once, each with a constant speed. Models `sensor_trajectory`; calls
/// throw what the chain throws, for either list of values.
struct joint_motion {
    kinematic_chain chain;     ///< whose joints move
    std::vector<double> from;  ///< the values at the time 0 [rad] or [m]
    std::vector<double> to;    ///< the values at the end
    double duration = 4.0;     ///< t_s [s]

    [[nodiscard]] pose operator()(double seconds) const {
        gnomon::detail::require(from.size() == to.size(),
                                "joint_motion: needs as many values at the end as at the start");
        std::vector<double> values;
        for (std::size_t i = 0; i < from.size(); ++i)
            values.push_back(from[i] + (to[i] - from[i]) * (seconds / duration));
        return chain(values);
    }
};

}  // namespace gnomon::simulation
