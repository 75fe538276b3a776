// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask recognize_scan for?
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "common/command_line.hpp"
#include <gnomon/core.hpp>

inline constexpr const char* usage =
    R"(usage: recognize_scan SCAN --model MODEL --out DIR [options]

Recognizes objects in SCAN (PLY, PCD, LAS, VTK or text; coordinates in metres): removes floor,
ceiling and walls, finds surfaces, groups those that are at most 10 cm apart into views of
objects, and decides which class of MODEL, a file of learn_objects, each view shows. Writes
labeled.ply, recognized.png and objects.json into DIR.

  --up X,Y,Z           against gravity (0,0,1)
  --floor H            height of the floor along --up [m], where SCAN does not show it
  --viewpoint X,Y,Z    position of the sensor (from SCAN, else 0,0,0)
  --noise M            standard deviation of the ranges (measured on SCAN)
  --divergence MRAD    full angle of wide beams [mrad]: the mixed points that they return between
                       two surfaces are left out, which connect objects to what is behind them
                       (0: of narrow beams, none is left out)
  --min-probability P  views that are less certain are background (as learned, 0.9)
  --threads N          0 for all there are (0)
  --help               this text

labeled.ply: label is the number of the view, -1 for points of none.
objects.json: views, by their largest parts: name ("background" where nothing was decided),
probability of the best class, points, center and box (upright, of the smallest base), pose
(middle of the base, and yaw of the longer edge [rad], known up to half a turn: that of the
box, not of the learned model), log_ratio (of the probabilities of the best and the second
class), and evidence: what was seen, the number of its word, and its share in log_ratio.

Exit status: 0; 1 if a file cannot be read or written, SCAN has no floor, or MODEL is
broken; 2 for a wrong command line.
)";

struct options {
    std::string scan, model, out;
    Eigen::Vector3d up{0.0, 0.0, 1.0};  ///< unit length
    std::optional<double> floor;        ///< [m]
    std::optional<Eigen::Vector3d> viewpoint;
    std::optional<double> sigma;  ///< [m]
    gnomon::angle divergence = gnomon::degrees(0.0);
    std::optional<double> min_probability;
    gnomon::threads threads;
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    common::model<options>,
    {"--up", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.up = vector_of(name, value).stableNormalized();
         if (!(o.up.norm() > 0.5)) throw usage_error("--up: 0,0,0 is no direction");
     }},
    {"--floor", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.floor = number_within(name, value, -1e9, 1e9, "within 1e9 m");
     }},
    {"--viewpoint", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.viewpoint = vector_of(name, value);
     }},
    {"--noise", true, common::sigma<options>.set},
    {"--divergence", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.divergence =
             gnomon::radians(1e-3 * number_within(name, value, 0.0, 100.0, "from 0 to 100"));
     }},
    {"--min-probability", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.min_probability = number_within(name, value, 0.0, 1.0, "from 0 to 1");
     }},
    common::threads<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense, or scan or model are missing
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    const auto o = options_from<options>(words, known_options, take_scan<options>);
    if (o && o->scan.empty()) throw usage_error("the scan is missing");
    if (o && o->model.empty()) throw usage_error("--model MODEL is missing");
    return o;
}
