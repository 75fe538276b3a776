// SPDX-License-Identifier: BSL-1.0
/// @file
/// The scenes by their names, and mesh files where Assimp is available.
#pragma once

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

#include <Eigen/Core>

#include "common/furniture_files.hpp"
#include "simulate_scan/options.hpp"
#include <gnomon/simulation.hpp>
#ifdef GNOMON_EXAMPLES_ASSIMP
#include <gnomon/adapters/assimp_scene.hpp>
#endif

namespace detail {

/// The scene of a mesh file, the sensor in its middle.
inline sim::scene scene_in_file(const std::string& path) {
#ifdef GNOMON_EXAMPLES_ASSIMP
    sim::scene world = sim::read_scene(path);
    const sim::bounds extent = world.extent();
    world.sensor = sim::at(extent.middle().x(), extent.middle().y(), extent.low.z() + 1.2) *
                   sim::pitch(gnomon::degrees(10));
    return world;
#else
    throw usage_error("--scene " + path +
                      ": no such scene, and this program was built without "
                      "Assimp, which reads mesh files");
#endif
}

/// A room with the furniture of files, if the options name some.
inline sim::scene furnished_room(const options& o) {
    constexpr int pieces_of_clutter = 22;  // of which a scan shows about 20
    sim::scenes::room_options room{.seed = o.beam.seed,
                                   .openings = o.openings,
                                   .clutter = o.clutter ? pieces_of_clutter : 0,
                                   .touching = o.touching};
    if (!o.furniture.empty())
        for (auto& file : common::furniture_in("--furniture", o.furniture, o.y_up)) {
            if (file.class_name != file.model.name)
                file.model.name = file.class_name + "/" + file.model.name;
            room.models.push_back(std::move(file.model));
        }
    sim::scene world = sim::scenes::furnished_room(room);
    const Eigen::Vector3d floor = world.shapes().front().extent.size();
    for (const auto& model : room.models) {
        const double across = 2.0 * sim::detail::radius_of(model);
        if (across > std::min(floor.x(), floor.y()))
            std::printf(
                "left out: %s, %.2f m across, is too large for this room of %.2f x %.2f m\n",
                model.name.c_str(), across, floor.x(), floor.y());
    }
    return world;
}

}  // namespace detail

/// The scene that the options name, with the sensor where they want it.
/// @throws usage_error    for a name that is neither a scene nor a file
/// @throws gnomon::error  for a mesh file that cannot be read
inline sim::scene scene_of(const options& o) {
    static const std::map<std::string, sim::scene (*)(const options&)> scenes{
        {"kitchen", [](const options&) { return sim::scenes::kitchen(); }},
        {"living_room", [](const options&) { return sim::scenes::living_room(); }},
        {"box_and_cylinder", [](const options&) { return sim::scenes::box_and_cylinder(); }},
        {"boxes_and_bin", [](const options&) { return sim::scenes::boxes_and_bin(); }},
        {"two_chairs", [](const options&) { return sim::scenes::two_chairs(); }},
        {"seat_armchair_table", [](const options&) { return sim::scenes::seat_armchair_table(); }},
        {"furnished_room", detail::furnished_room},
        {"street",
         [](const options& with) { return sim::scenes::street({.seed = with.beam.seed}); }}};
    const auto known = scenes.find(o.scene);
    if (known == scenes.end() && o.scene.find('.') == std::string::npos)
        throw usage_error("--scene: '" + o.scene + "' is neither a scene nor the name of a file");

    if (!o.furniture.empty() && o.scene != "furnished_room")
        throw usage_error("--furniture: only furnished_room takes furniture of files");
    sim::scene world = known != scenes.end() ? known->second(o) : detail::scene_in_file(o.scene);
    const Eigen::Vector3d place = o.sensor.value_or(world.sensor.position);
    if (o.pitch) world.sensor = sim::pitch(*o.pitch);
    world.sensor = sim::yaw(o.yaw.value_or(gnomon::angle{})) * world.sensor;
    world.sensor.position = place;
    return world;
}
