// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask measure_a_room for?
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/command_line.hpp"
#include <gnomon/gnomon.hpp>

inline constexpr const char* usage =
    R"(usage: measure_a_room [SCAN] --out DIR [options]

Measures the room in SCAN (PLY, PCD, LAS, VTK or text; coordinates in metres): floor, ceiling,
walls, doors and windows, and the lengths of these with their standard deviations.
Without SCAN, a simulated room. Writes room.png, a floor plan, and room.json into DIR.

  --viewpoint X,Y,Z   position of the sensor (from SCAN, else 0,0,0)
  --up X,Y,Z          against gravity (0,0,1)
  --sigma M           standard deviation of ranges (measured on SCAN)
  --seed N            of the simulated room (1)
  --threads N         0 for all there are (0)
  --help              this text

Distances between opposite walls are measured in the middle of both, lengths of walls from
corner to corner, openings from edge to edge, in the plane of the wall. Standard deviations
[m] are those of random errors: of the noise, more where a surface is not quite flat, and
for edges of the distance of rays too. A constant error of all ranges is not in them.

room.json: points, lengths (kind, name, value and sigma), walls (corners on the floor) and
openings (name, wall, and corners).

Exit status: 0; 1 if a file cannot be read or written, or SCAN has no floor and no walls; 2
for a wrong command line.
)";

struct options {
    std::string scan;  ///< path, or empty for a simulated room
    std::string out;
    std::optional<Eigen::Vector3d> viewpoint;
    Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< unit length
    std::optional<double> sigma;        ///< [m]
    std::uint64_t seed = 1;
    gnomon::threads threads;
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    {"--viewpoint", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.viewpoint = vector_of(name, value);
     }},
    {"--up", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.up = vector_of(name, value).stableNormalized();
         if (!(o.up.norm() > 0.5)) throw usage_error("--up: 0,0,0 is no direction");
     }},
    common::sigma<options>,
    {"--seed", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.seed = seed_of(name, value);
     }},
    common::threads<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    return options_from<options>(words, known_options, take_scan<options>);
}
