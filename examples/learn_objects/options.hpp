// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask learn_objects for?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include <gnomon/core.hpp>

inline constexpr const char* usage =
    R"(usage: learn_objects --out MODEL [options]

Learns classes of objects from simulated scans of models, each model alone at random places
in front of a range finder, and writes what recognize_scan and segment_scan need to know
into the file MODEL (JSON).

  --models DIR        mesh files (obj, stl, ply, off, dae, gltf, glb; metres), or one of them,
                      in place of the built-in twelve pieces of furniture. A file is a class
                      of its own, with its name; the files in a folder of DIR are one class
                      with the name of the folder. The class of the folder "background"
                      stands for whatever is no object; without that folder it is learned
                      from built-in cupboards, cartons, bins and pieces of walls
  --office            learns the classes "chair" and "table": the built-in furniture but the
                      stool, and office chairs, desks and side tables of random sizes, most
                      tables with things on them, by N / 4 scans of each; and more clutter as
                      background. Files of --models are learned in addition, by N scans of
                      each: put those of other chairs into a folder named chair
  --y-up              the y axis of the files points up, not z
  --views N           scans of each model (40)
  --seed N            of all that is random (1)
  --sigma M           standard deviation of the ranges (0.005)
  --threads N         0 for all there are (0)
  --help              this text

From each scan six views are learned: the whole one, and two of which a part is hidden, each in
its parts and as one part.

Exit status: 0; 1 if a file cannot be read or written; 2 for a wrong command line.
)";

struct options {
    static constexpr const char* name_of_out = "MODEL";
    std::string out;     ///< path of the model file
    std::string models;  ///< directory or file; empty for the built-in models
    bool office = false;
    bool y_up = false;
    std::size_t views = 40;
    std::uint64_t seed = 1;
    double sigma = 0.005;  ///< [m]
    gnomon::threads threads;
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    {"--models", true,
     [](options& o, const std::string& name, const std::string& value) {
         if (value.empty()) throw usage_error(name + ": its value is missing");
         o.models = value;
     }},
    {"--office", false,
     [](options& o, const std::string&, const std::string&) { o.office = true; }},
    {"--y-up", false, [](options& o, const std::string&, const std::string&) { o.y_up = true; }},
    {"--views", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.views = number_within<std::size_t>(name, value, 1, 100'000, "from 1 to 100,000");
     }},
    {"--seed", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.seed = seed_of(name, value);
     }},
    common::sigma<options>,
    common::threads<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    return options_from<options>(words, known_options, [](options&, const std::string& word) {
        throw usage_error("'" + word + "' is no option; models go after --models");
    });
}
