// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask segment_scan for?
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "common/command_line.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>

inline constexpr const char* usage =
    R"(usage: segment_scan [SCAN] --out DIR [options]

Segments SCAN (PLY, PCD, VTK or text; coordinates in metres) into smooth surfaces,
and merges surfaces that something occludes in part; without SCAN, a simulated
kitchen. Writes normals.ply, segments.ply, segments.png and segments.json into DIR.

  --k N               neighbors per point (50)
  --max-angle DEG     largest angle between normals of neighbors (5)
  --max-distance M    largest distance between adjacent points (0.30)
  --min-points N      smaller segments are discarded (30)
  --merge POLICY      conservative: where the gap is occluded (default);
                      liberal: unless the gap is free space; or none
  --sigma M           standard deviation of ranges, for merging and unlabeled points (0.015)
  --viewpoint X,Y,Z   position of the sensor (from SCAN, else 0,0,0)
  --remove-floor      leave out floor and ceiling
  --up X,Y,Z          against gravity (0,0,1)
  --threads N         0 for all there are (0)
  --help              this text
)";

struct options {
    std::string scan;  ///< path, or empty for the simulated kitchen
    std::string out;
    gnomon::knn neighborhood{.ties = gnomon::tie_rule::all};
    gnomon::segment_surfaces_options segmentation;
    std::optional<Eigen::Vector3d> viewpoint;
    std::optional<Eigen::Vector3d> up;  ///< unit length
    std::variant<gnomon::conservative, gnomon::liberal, gnomon::no_merging> merge;
    double sigma = 0.015;  ///< [m]
    bool remove_floor = false;
    gnomon::threads threads;
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    {"--k", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.neighborhood.k =
             number_within<std::size_t>(name, value, 1, 100'000, "from 1 to 100,000");
     }},
    {"--max-angle", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.max_angle =
             gnomon::degrees(number_within(name, value, 0.0, 90.0, "from 0 to 90"));
     }},
    {"--max-distance", true,
     [](options& o, const std::string& name, const std::string& value) {
         constexpr double infinity = std::numeric_limits<double>::infinity();
         o.segmentation.max_distance = number_within(name, value, 0.0, infinity, "0 or more");
     }},
    {"--min-points", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.min_points =
             number_within<std::size_t>(name, value, 1, 1'000'000'000, "from 1 to 1,000,000,000");
     }},
    {"--merge", true,
     [](options& o, const std::string& name, const std::string& value) {
         if (value == "conservative")
             o.merge = gnomon::conservative{};
         else if (value == "liberal")
             o.merge = gnomon::liberal{};
         else if (value == "none")
             o.merge = gnomon::no_merging{};
         else
             throw usage_error(name + ": '" + value + "' is not conservative, liberal or none");
     }},
    {"--sigma", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.sigma = number_within(name, value, 1e-9, 1e9, "from 1e-9 to 1e9");
     }},
    {"--viewpoint", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.viewpoint = vector_of(name, value);
     }},
    {"--remove-floor", false,
     [](options& o, const std::string&, const std::string&) { o.remove_floor = true; }},
    {"--up", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.up = vector_of(name, value).stableNormalized();
         if (!(o.up->norm() > 0.5)) throw usage_error("--up: 0,0,0 is no direction");
     }},
    common::threads<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    return options_from<options>(words, known_options, take_scan<options>);
}
