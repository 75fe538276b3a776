// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask compare_estimators for?
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

inline constexpr const char* usage =
    R"(usage: compare_estimators [SCAN] --out DIR [options]

Runs every estimator of the library on SCAN, a PLY file with the true normals as nx, ny, nz
(simulate_scan writes such files); without SCAN, on a simulated kitchen of 28,800 points. Prints a
table, and writes estimators.png into DIR.

  --k N           neighbors per point (30)
  --delaunay      on Delaunay stars instead of k nearest neighbors
  --sigma M       standard deviation of the range: of the simulated scan, and what the filters are
                  told (0.015)
  --seed N        of the simulated noise (1)
  --threads N     0 for all there are; times are by the clock (1)
  --help          this text
)";

struct options {
    std::string scan;  ///< path, or empty for the simulated kitchen
    std::string out;
    std::size_t k = 30;
    bool delaunay = false;
    double sigma = 0.015;
    std::uint64_t seed = 1;
    gnomon::threads threads{1};
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    common::k<options>,
    {"--delaunay", false,
     [](options& o, const std::string&, const std::string&) { o.delaunay = true; }},
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
