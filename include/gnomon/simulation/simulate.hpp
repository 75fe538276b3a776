// SPDX-License-Identifier: BSL-1.0
/// @file
/// Simulates the scan of a scene. A range finder or a spinning lidar moves along its trajectory,
/// and each beam gives a reading; a depth camera stands still, and each pixel gives one. Each valid
/// reading is a point (Klasing 2010, Sec. 2.4.3).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include <gnomon/core/error.hpp>
#include <gnomon/core/execution.hpp>
#include <gnomon/core/point.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/core/viewpoints.hpp>
#include <gnomon/simulation/beam.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/depth_camera.hpp>
#include <gnomon/simulation/detail/instrument.hpp>
#include <gnomon/simulation/detail/line_scanner.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/trajectory.hpp>
#include <gnomon/simulation/true_scan.hpp>

namespace gnomon::simulation {

namespace detail {

/// A reading that is kept as a point, and the number of its ray.
template <ray_caster C>
struct numbered_reading {
    std::size_t ray;
    typename instrument<C>::reading reading;
};

/// The kept readings of the rays ray_of(0) to ray_of(rays - 1), in chunks in the order of the rays.
/// Memory is proportional to the kept readings, not to the rays.
template <ray_caster C, execution X>
[[nodiscard]] std::vector<std::vector<numbered_reading<C>>> read_rays(auto&& read, const beam& b,
                                                                      std::size_t rays,
                                                                      auto&& ray_of, const X& run) {
    std::vector<std::vector<numbered_reading<C>>> chunks(gnomon::detail::chunk_count(rays));
    gnomon::detail::for_each_chunk(run, rays, [&](std::size_t begin, std::size_t end) {
        auto& kept = chunks[begin / gnomon::detail::chunk_size];
        for (std::size_t i = begin; i < end; ++i) {
            random_stream random(b.seed, i);
            auto reading = read(ray_of(i), random);
            if (reading.kind != echo::none || b.keep_failed) kept.push_back({i, reading});
        }
        kept.shrink_to_fit();
    });
    return chunks;
}

/// The points of the readings and their ground truth.
/// @throws std::invalid_argument  for a hit on a surface that `world` does not have
[[nodiscard]] true_scan points_of(const auto& chunks, const scene& world, auto&& ray_of) {
    std::size_t n = 0;
    for (const auto& kept : chunks) n += kept.size();
    true_scan result;
    result.scan.points.reserve(n);
    result.normals.reserve(n);
    result.surfaces.reserve(n);
    result.parts.reserve(n);
    result.objects.reserve(n);
    result.ranges.reserve(n);
    result.directions.reserve(n);
    result.echoes.reserve(n);
    for (const auto& kept : chunks) {
        for (const auto& [number, reading] : kept) {
            const ray r = ray_of(number);
            result.scan.points.push_back(r.point_at(reading.range));
            result.directions.push_back(r.direction);
            result.echoes.push_back(reading.kind);
            Eigen::Vector3d normal(0.0, 0.0, 0.0);
            double range = std::numeric_limits<double>::quiet_NaN();
            std::int32_t surface = nothing;
            std::int32_t part = nothing;
            std::int32_t object = nothing;
            if (reading.hit) {
                normal = reading.hit->normal;
                range = reading.hit->range;
                surface = reading.hit->surface;
                gnomon::detail::require(
                    surface >= 0 && static_cast<std::size_t>(surface) < world.surfaces().size(),
                    "simulate: the caster is of another scene");
                part = world.surfaces()[static_cast<std::size_t>(surface)].part;
                object = world.parts()[static_cast<std::size_t>(part)].object;
            }
            result.normals.push_back(normal);
            result.ranges.push_back(range);
            result.surfaces.push_back(surface);
            result.parts.push_back(part);
            result.objects.push_back(object);
        }
    }
    return result;
}

/// Where the lines of a scan are measured.
struct measured_lines {
    std::vector<pose> poses;                  ///< of the lines' frames in the scene
    std::vector<Eigen::Vector3d> viewpoints;  ///< of the lines [m]

    /// @throws std::invalid_argument  if the duration is negative or not finite, there are more
    ///                                rays than a point range may hold, or a pose of the trajectory
    ///                                is no rigid motion
    measured_lines(const sensor_trajectory auto& trajectory, const line_scanner auto& finder) {
        const double duration = trajectory.duration;
        const double rate = finder.line_rate();
        gnomon::detail::require(duration >= 0.0 && duration * rate < 4e9,
                                "simulate: the duration must be finite and not negative");
        const std::size_t lines = finder.lines(duration);
        gnomon::detail::require(lines < std::numeric_limits<point_index>::max() / finder.beams(),
                                "simulate: more rays than a point range may hold");
        for (std::size_t line = 0; line < lines; ++line) {
            const pose sensor = trajectory((static_cast<double>(line) + 0.5) / rate);
            gnomon::detail::require(is_rigid(sensor),
                                    "simulate: a pose of the trajectory is no rigid motion");
            poses.push_back(sensor * finder.line_pose(line));
            viewpoints.push_back(sensor.position);
        }
    }

    /// One view point for the points of all readings, or one per line if the sensor moves.
    [[nodiscard]] viewpoint_table table(const auto& chunks, std::size_t beams) && {
        if (viewpoints.empty()) return {};
        const bool moves =
            std::any_of(viewpoints.begin(), viewpoints.end(), [&](const Eigen::Vector3d& v) {
                return squared_distance(v, viewpoints.front()) > 0.0;
            });
        if (!moves) return viewpoints.front();
        std::vector<point_index> line_of_point;
        for (const auto& kept : chunks) {
            for (const auto& one : kept)
                line_of_point.push_back(static_cast<point_index>(one.ray / beams));
        }
        return viewpoint_table(std::move(viewpoints), std::move(line_of_point));
    }
};

}  // namespace detail

/// Simulates a scan, line by line, with the given ray caster.
///
/// The same seed gives the same bytes for every execution.
/// Complexity: O(n log(shapes)), times the number of sub-rays if the beam has a footprint; memory
/// is proportional to the points and the lines, not to the rays.
///
/// @param world   source of the ground truth. Precondition: `caster` was built from it
/// @param finder  a `scanner` or a `spinning_lidar`; gives n = lines(duration) * beams() rays
/// @return the points of all readings that did not fail, with keep_failed also of those that did;
///         one view point for all points, or, if the sensor moves, one per scan line or column
/// @throws std::invalid_argument  if scanner or beam are not valid, the duration is negative or not
///                                finite, there are more rays than a point range may hold, a pose
///                                of the trajectory is no rigid motion, or the caster reports
///                                a surface that `world` does not have
template <ray_caster C, sensor_trajectory T, detail::line_scanner S = scanner,
          execution X = sequential>
[[nodiscard]] true_scan simulate(const scene& world, const C& caster, const T& trajectory,
                                 const S& finder = {}, const beam& b = {}, const X& run = {}) {
    finder.require_valid();
    detail::measured_lines lines(trajectory, finder);
    const detail::instrument<C> read(caster, b, finder.min_range, finder.max_range);
    const std::size_t beams = finder.beams();
    std::vector<Eigen::Vector3d> fan;
    for (std::size_t j = 0; j < beams; ++j) fan.push_back(finder.direction(j));
    const auto ray_of = [&](std::size_t i) {
        const pose& line = lines.poses[i / beams];
        return ray{line.position, line.direction_out(fan[i % beams])};
    };

    const auto readings = detail::read_rays<C>(read, b, lines.poses.size() * beams, ray_of, run);
    true_scan result = detail::points_of(readings, world, ray_of);
    result.scan.viewpoints = std::move(lines).table(readings, beams);
    return result;
}

/// Simulates a scan, as above, with a `bvh_caster`.
template <sensor_trajectory T, detail::line_scanner S = scanner, execution X = sequential>
[[nodiscard]] true_scan simulate(const scene& world, const T& trajectory, const S& finder = {},
                                 const beam& b = {}, const X& run = {}) {
    return simulate(world, bvh_caster(world), trajectory, finder, b, run);
}

/// Simulates the image of a depth camera, row by row, with the given ray caster. Errors of the beam
/// come before those of the camera; `{.footprint = camera.pixel()}` gives pixels their width.
///
/// The same seed gives the same bytes for every execution.
/// Complexity: O(n log(shapes)), times the number of sub-rays if the beam has a footprint.
///
/// @param world   source of the ground truth. Precondition: `caster` was built from it
/// @param sensor  the pose of the camera
/// @return the points of all readings that did not fail, with one view point; with keep_failed also
///         of those that did
/// @throws std::invalid_argument  if camera or beam are not valid, the pose is no rigid motion, or
///                                the caster reports a surface that `world` does not have
template <ray_caster C, execution X = sequential>
[[nodiscard]] true_scan simulate(const scene& world, const C& caster, const pose& sensor,
                                 const depth_camera& camera, const beam& b = {},
                                 const X& run = {}) {
    camera.require_valid();
    gnomon::detail::require(is_rigid(sensor), "simulate: the pose is no rigid motion");
    const auto ray_of = [&](std::size_t pixel) {
        return ray{sensor.position, sensor.direction_out(camera.direction(pixel))};
    };
    const detail::instrument<C> read(caster, b, 0.0, camera.max_range());
    const Eigen::Vector3d axis = sensor.direction_out({1.0, 0.0, 0.0});
    const auto read_depth = [&](const ray& r, random_stream& random) {
        auto reading = read(r, random);
        if (reading.kind == echo::none) return reading;
        const double cosine = axis.dot(r.direction), z = reading.range * cosine;
        const double noisy = camera.reported(z + camera.noise(z) * random.gaussian());
        if (camera.sees(z) && camera.sees(noisy)) {
            reading.range = noisy / cosine;
        } else {
            reading = {echo::none, camera.max_range(), std::nullopt};
        }
        return reading;
    };
    const auto readings = detail::read_rays<C>(read_depth, b, camera.pixels(), ray_of, run);
    true_scan result = detail::points_of(readings, world, ray_of);
    result.scan.viewpoints = sensor.position;
    return result;
}

/// Simulates the image of a depth camera, as above, with a `bvh_caster`.
template <execution X = sequential>
[[nodiscard]] true_scan simulate(const scene& world, const pose& sensor, const depth_camera& camera,
                                 const beam& b = {}, const X& run = {}) {
    return simulate(world, bvh_caster(world), sensor, camera, b, run);
}

}  // namespace gnomon::simulation
