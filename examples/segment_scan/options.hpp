// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask segment_scan for?
#pragma once

#include <cctype>
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

Segments SCAN (PLY, PCD, LAS, VTK or text; coordinates in metres) into planes and smooth
surfaces, and merges planes that something occludes in part; without SCAN, a
simulated kitchen. Writes normals.ply, segments.ply, segments.png and segments.json
into DIR.

  --noise NOISE       standard deviation of ranges: measured on SCAN (default), or a
                      number of metres, or the model of a depth camera:
                      structured_light, time_of_flight or stereo
  --sigma M           the same as --noise M
  --k N               neighbors per normal, at most (30)
  --max-angle DEG     largest angle between a normal and its plane's, where planes
                      grow (15)
  --min-points N      smaller segments are discarded, counted in cells as wide as
                      the noise (30)
  --merge POLICY      conservative: where the gap is occluded (default);
                      liberal: unless the gap is free space; or none
  --viewpoint X,Y,Z   position of the sensor (from SCAN, else 0,0,0)
  --remove-floor      leave out floor and ceiling
  --up X,Y,Z          against gravity (0,0,1)
  --model MODEL       name the objects that segments belong to, which a file of
                      learn_objects knows; SCAN must show the floor
  --polygons          write polygons.ply too, a mesh of the polygons of flat segments
  --threads N         0 for all there are (0)
  --help              this text

segments.json: points, valid (finite ones), noise (model, and standard deviation at
1 m and 3 m), seconds of each step, segments_before_merging, and segments, largest
first. The plane of a segment (normal . x = offset) is null where it is not flat; its
covariance is of turns about the first two axes of the box [rad], and of a shift along
the third, its normal [m], at its centroid. The box of a flat segment is the rectangle
of smallest area around its points, moved along their rays to the plane; its third
length is the rms distance from the plane. Else it is the box of smallest volume. Its
polygon has an outline, counterclockwise seen against the normal, holes, area [m^2],
and as islands further polygons; it is null where there is none. With --model the object
of a segment is that of most of its points, as recognize_scan finds them by surfaces of its
own, or "background".

Exit status: 0; 1 if a file cannot be read or written, or SCAN cannot be processed; 2
for a wrong command line.
)";

/// The noise of the sensor, as the user names it.
struct named_noise {
    std::string name = "measured";
    std::variant<std::monostate, gnomon::constant_noise, gnomon::quadratic_noise> model;
};

struct options {
    std::string scan;  ///< path, or empty for the simulated kitchen
    std::string out;
    std::string model;  ///< path, or empty: objects are not named
    gnomon::noise_knn neighborhood;
    gnomon::planes_on_cells segmentation;
    named_noise noise;
    std::optional<Eigen::Vector3d> viewpoint;
    std::optional<Eigen::Vector3d> up;  ///< unit length
    std::variant<gnomon::conservative, gnomon::liberal, gnomon::no_merging> merge;
    bool remove_floor = false;
    bool polygons = false;
    gnomon::threads threads;
};

/// A standard deviation in metres.
inline named_noise constant_noise_of(const std::string& name, const std::string& value) {
    const double sigma = number_within(name, value, 1e-9, 1e9, "from 1e-9 to 1e9");
    return {"constant", gnomon::constant_noise{sigma}};
}

/// `measured`, the name of a model, or a standard deviation in metres.
inline named_noise noise_of(const std::string& name, const std::string& value) {
    if (value == "measured") return {};
    if (value == "structured_light") return {value, gnomon::noises::structured_light()};
    if (value == "time_of_flight") return {value, gnomon::noises::time_of_flight()};
    if (value == "stereo") return {value, gnomon::noises::stereo()};
    const bool is_word = value.empty() || std::isalpha(static_cast<unsigned char>(value.front()));
    if (is_word)
        throw usage_error(name + ": '" + value +
                          "' is not measured, structured_light, time_of_flight, stereo or a number "
                          "of metres");
    return constant_noise_of(name, value);
}

inline constexpr option<options> known_options[] = {
    common::out<options>,
    common::model<options>,
    {"--k", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.neighborhood.k =
             number_within<std::size_t>(name, value, 1, 100'000, "from 1 to 100,000");
     }},
    {"--max-angle", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.planes.max_angle =
             gnomon::degrees(number_within(name, value, 0.0, 90.0, "from 0 to 90"));
     }},
    {"--min-points", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.segmentation.planes.min_points =
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
    {"--noise", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.noise = noise_of(name, value);
     }},
    {"--sigma", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.noise = constant_noise_of(name, value);
     }},
    {"--viewpoint", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.viewpoint = vector_of(name, value);
     }},
    {"--remove-floor", false,
     [](options& o, const std::string&, const std::string&) { o.remove_floor = true; }},
    {"--polygons", false,
     [](options& o, const std::string&, const std::string&) { o.polygons = true; }},
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
