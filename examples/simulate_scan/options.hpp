// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask simulate_scan for?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/command_line.hpp"
#include <gnomon/core.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

inline constexpr const char* usage =
    R"(usage: simulate_scan --out DIR [options]

Scans a scene with a simulated range finder, depth camera or spinning lidar. Writes scan.ply, the points with
what is true of them (normal, object, part, surface, range, echo), scan.png and names.json into DIR.

  --scene NAME         kitchen, living_room, box_and_cylinder, boxes_and_bin, two_chairs,
                       seat_armchair_table, furnished_room or street (of the seed), or a mesh file
                       such as FILE.obj, z up, in metres (kitchen)
  --openings           doors and windows in the walls of furnished_room
  --clutter            cartons, plants, shelves and other things in furnished_room
  --touching           the furniture of furnished_room touches walls and each other
  --furniture DIR      the furniture of furnished_room: mesh files, as --models of learn_objects
  --y-up               the y axis of these files points up, not z
  --scanner NAME       range_finder; a depth camera with its own resolution and noise:
                       structured_light, time_of_flight or stereo; or one sweep of a spinning lidar:
                       velodyne_vlp_16, velodyne_hdl_32e or velodyne_hdl_64e (range_finder)
  --trajectory NAME    of a range finder: horizontal, vertical or rotational (rotational)
  --density NAME       of a range finder: low, medium or high, 7,200, 28,800 or 115,200 beams (high)
  --sigma M            of a range finder or lidar: standard deviation of the range (0.015)
  --skimmed            beams (4 mrad) or pixels of finite width, which meet several surfaces at
                       edges
  --seed N             of all that is random (1)
  --sensor X,Y,Z       where the sensor stands (as the scene says; in a mesh file the middle, 1.2 m
                       above the ground)
  --yaw DEG            to the left (0)
  --pitch DEG          downwards (as the scene says; in a mesh file 10)
  --threads N          0 for all there are (0)
  --help               this text
)";

/// The range finder of --density, a depth camera, or a spinning lidar.
using instrument = std::variant<std::monostate, sim::depth_camera, sim::spinning_lidar>;

enum class trajectory_kind : char { horizontal, vertical, rotational };

struct options {
    std::string scene = "kitchen";  ///< a name, or the path of a mesh file
    std::string out;
    trajectory_kind trajectory = trajectory_kind::rotational;
    instrument device;  ///< in place of the range finder, if it is another one
    sim::scanner finder;
    sim::beam beam{.sigma = 0.015};
    bool skimmed = false;
    bool openings = false;
    bool clutter = false;
    bool touching = false;
    std::string furniture;  ///< directory or file; empty for the built-in furniture
    bool y_up = false;
    std::optional<Eigen::Vector3d> sensor;
    std::optional<gnomon::angle> yaw;
    std::optional<gnomon::angle> pitch;
    gnomon::threads threads;
};

/// The meaning of a word among a few.
template <class Meaning>
struct choice {
    const char* word;
    Meaning meaning;
};

/// @throws usage_error  if `value` is none of the words
template <class Meaning, std::size_t n>
Meaning chosen(const std::string& name, const std::string& value,
               const choice<Meaning> (&choices)[n]) {
    std::string words;
    for (const auto& [word, meaning] : choices) {
        if (value == word) return meaning;
        words += words.empty() ? word : std::string(", ") + word;
    }
    throw usage_error(name + ": must be one of " + words + ", not " + value);
}

inline gnomon::angle angle_of(const std::string& name, const std::string& value) {
    return gnomon::degrees(number_within(name, value, -360.0, 360.0, "from -360 to 360"));
}

inline const option<options> known_options[] = {
    {"--scene", true,
     [](options& o, const std::string&, const std::string& value) { o.scene = value; }},
    {"--scanner", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.device = chosen<instrument>(name, value,
                                       {{"range_finder", std::monostate()},
                                        {"structured_light", sim::scanners::structured_light()},
                                        {"time_of_flight", sim::scanners::time_of_flight()},
                                        {"stereo", sim::scanners::stereo()},
                                        {"velodyne_vlp_16", sim::scanners::velodyne_vlp_16()},
                                        {"velodyne_hdl_32e", sim::scanners::velodyne_hdl_32e()},
                                        {"velodyne_hdl_64e", sim::scanners::velodyne_hdl_64e()}});
     }},
    {"--trajectory", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.trajectory = chosen<trajectory_kind>(name, value,
                                                {{"horizontal", trajectory_kind::horizontal},
                                                 {"vertical", trajectory_kind::vertical},
                                                 {"rotational", trajectory_kind::rotational}});
     }},
    {"--density", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.finder = chosen<sim::scanner>(name, value,
                                         {{"low", sim::densities::low()},
                                          {"medium", sim::densities::medium()},
                                          {"high", sim::densities::high()}});
     }},
    {"--sigma", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.beam.sigma = number_within(name, value, 0.0, 10.0, "from 0 to 10");
     }},
    {"--openings", false,
     [](options& o, const std::string&, const std::string&) { o.openings = true; }},
    {"--clutter", false,
     [](options& o, const std::string&, const std::string&) { o.clutter = true; }},
    {"--touching", false,
     [](options& o, const std::string&, const std::string&) { o.touching = true; }},
    {"--furniture", true,
     [](options& o, const std::string& name, const std::string& value) {
         if (value.empty()) throw usage_error(name + ": its value is missing");
         o.furniture = value;
     }},
    {"--y-up", false, [](options& o, const std::string&, const std::string&) { o.y_up = true; }},
    {"--skimmed", false,
     [](options& o, const std::string&, const std::string&) { o.skimmed = true; }},
    {"--seed", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.beam.seed = seed_of(name, value);
     }},
    {"--sensor", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.sensor = vector_of(name, value);
     }},
    {"--yaw", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.yaw = angle_of(name, value);
     }},
    {"--pitch", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.pitch = angle_of(name, value);
     }},
    common::threads<options>,
    common::out<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    return options_from<options>(words, known_options, [](options&, const std::string& word) {
        throw usage_error("'" + word + "' is no option; a scene goes after --scene");
    });
}
