// SPDX-License-Identifier: BSL-1.0
/// @file
/// The scans that plane_segmentation looks at: two with labels by others, of a kind each, and
/// simulated ones of the same kinds, made by the simulator.
#pragma once

#include <cmath>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "plane_methods.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/io/read.hpp>
#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/normals/noise_level.hpp>
#include <gnomon/simulation.hpp>

namespace planes {

/// The median distance from a point to its nearest neighbor [m].
inline double spacing_of(const std::vector<Eigen::Vector3d>& points) {
    const gnomon::spatial_index index(points);
    std::vector<double> distances;
    std::vector<gnomon::neighbor> found;
    for (std::size_t i = 0; i < points.size(); i += 1 + points.size() / 5000) {
        if (!index.is_finite(i)) continue;
        gnomon::knn{.k = 1}.find(index, i, found);
        if (!found.empty()) distances.push_back(std::sqrt(found[0].squared_distance));
    }
    return distances.empty() ? 0.0 : gnomon::detail::quantile(distances, 0.5);
}

/// A cloud of the finite points, with its regions numbered from 0; those of labels under
/// `first_label` are background.
inline cloud cloud_of(std::string name, const std::vector<Eigen::Vector3d>& points,
                      const auto& labels_of_points, double first_label) {
    cloud c;
    c.name = std::move(name);
    std::map<double, std::int32_t> number;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!gnomon::is_finite(points[i])) continue;
        c.points.push_back(points[i]);
        const auto label = static_cast<double>(labels_of_points[i]);
        const auto next = static_cast<std::int32_t>(number.size());
        c.truth.push_back(label < first_label ? -1 : number.try_emplace(label, next).first->second);
    }
    c.noise = gnomon::noise_level(c.points);
    c.spacing = spacing_of(c.points);
    return c;
}

/// A file with a field of labels.
inline cloud read_labelled(const std::string& name, const std::string& path,
                           const std::string& field, double first_label) {
    const gnomon::scan scan = gnomon::io::read(path, {field});
    return cloud_of(name, scan.points, scan.fields[0].values, first_label);
}

/// Turned at random about all axes.
inline gnomon::simulation::pose turned(gnomon::random_stream& random) {
    using gnomon::degrees;
    return gnomon::simulation::yaw(degrees(random.uniform(-180, 180))) *
           gnomon::simulation::pitch(degrees(random.uniform(-90, 90))) *
           gnomon::simulation::roll(degrees(random.uniform(-180, 180)));
}

/// Blocks at random attitudes in front of walls, scanned once: an image of `size` x `size` beams
/// within 40 x 40 degrees, with noise in range.
inline cloud blocks(std::uint64_t seed, int size, double sigma) {
    using namespace gnomon;
    using namespace gnomon::simulation;
    random_stream random(seed);
    scene world;
    world.add_object("floor", plane_patch{12.0, 12.0}, at(0, 0, -1.2));
    world.add_object("wall", plane_patch{12.0, 12.0}, at(4.8, 0, 0) * pitch(degrees(90)));
    world.add_object("side", plane_patch{12.0, 12.0}, at(0, 1.7, 0) * roll(degrees(90)));
    for (int i = 0; i < 7; ++i) {
        const box b{random.uniform(0.3, 1.0), random.uniform(0.3, 1.0), random.uniform(0.3, 1.0)};
        const pose place =
            at(random.uniform(2.4, 4.2), random.uniform(-1.3, 1.3), random.uniform(-1.0, 1.0));
        world.add_object("block", b, place * turned(random));
    }
    const scanner finder{.field_of_view = degrees(40),
                         .resolution = degrees(40.0 / size),
                         .frequency = static_cast<double>(size)};
    const auto scan = simulate(world, vertical{.duration = 1.0, .sweep = degrees(40)}, finder,
                               {.sigma = sigma, .seed = seed}, threads{});
    return cloud_of("blocks " + std::to_string(size) + "x" + std::to_string(size) + " " +
                        assigned("sigma_mm", 1e3 * sigma) + " " +
                        assigned("seed", static_cast<double>(seed)),
                    scan.scan.points, scan.surfaces, 0.0);
}

/// A furnished room seen from four corners; regions are the parts of its furniture, background are
/// floor, ceiling and walls.
inline cloud furniture(std::uint64_t seed, double sigma) {
    using namespace gnomon;
    using namespace gnomon::simulation;
    const scene world = scenes::furnished_room({.pieces = 8, .seed = seed});
    std::vector<Eigen::Vector3d> points;
    std::vector<std::int32_t> part;
    for (int view = 0; view < 4; ++view) {
        const double x = view < 2 ? 0.5 : 3.5;
        const double y = view % 2 == 0 ? -1.5 : 1.5;
        const pose mount = at(x, y, 1.5) * yaw(degrees(view < 2 ? 0 : 180)) * pitch(degrees(20));
        const auto scan =
            simulate(world, vertical{.mount = mount, .duration = 1.0, .sweep = degrees(80)},
                     {.field_of_view = degrees(140), .resolution = degrees(0.5), .frequency = 160},
                     {.sigma = sigma, .seed = seed + static_cast<std::uint64_t>(view)}, threads{});
        points.insert(points.end(), scan.scan.points.begin(), scan.scan.points.end());
        for (std::size_t i = 0; i < scan.parts.size(); ++i) {
            const std::int32_t p = scan.parts[i];
            const bool is_room =
                p < 0 || world.objects()[static_cast<std::size_t>(
                             world.parts()[static_cast<std::size_t>(p)].object)] == "room";
            part.push_back(is_room ? -1 : p);
        }
    }
    return cloud_of("furniture " + assigned("sigma_mm", 1e3 * sigma) + " " +
                        assigned("seed", static_cast<double>(seed)),
                    points, part, 0.0);
}

}  // namespace planes
