// SPDX-License-Identifier: BSL-1.0
/// @file
/// The instruments that measure line by line: a scan line of a 2D range finder and a column of a
/// spinning lidar are both a fan of beams with one pose and one time. Lines follow each other at a
/// constant rate, and only the pose of a line within the sensor differs between instruments.
#pragma once

#include <concepts>
#include <cstddef>

#include <Eigen/Core>

#include <gnomon/core/detail/cmath.hpp>
#include <gnomon/simulation/pose.hpp>

namespace gnomon::simulation::detail {

/// An instrument that measures lines of beams(). Line i is measured (i + 0.5) / line_rate() seconds
/// after the start; line_pose(i) is the pose of its frame in the sensor's frame, without
/// translation; direction(j) is the direction of beam j in the frame of its line, of unit length.
template <class S>
concept line_scanner = requires(const S& s, std::size_t number, double seconds) {
    { s.beams() } -> std::same_as<std::size_t>;
    { s.lines(seconds) } -> std::same_as<std::size_t>;
    { s.line_rate() } -> std::same_as<double>;
    { s.line_pose(number) } -> std::same_as<pose>;
    { s.direction(number) } -> std::same_as<Eigen::Vector3d>;
    { s.min_range } -> std::convertible_to<double>;
    { s.max_range } -> std::convertible_to<double>;
    s.require_valid();
};

/// The largest integer not above x, with a tolerance of 1e-6 for rounding.
[[nodiscard]] inline std::size_t whole(double x) {
    return static_cast<std::size_t>(std::floor(x + 1e-6));
}

}  // namespace gnomon::simulation::detail
