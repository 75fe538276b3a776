// SPDX-License-Identifier: BSL-1.0
/// @file
/// What can one ask normal_uncertainty for?
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/command_line.hpp"
#include <gnomon/gnomon.hpp>

inline constexpr const char* usage =
    R"(usage: normal_uncertainty [SCAN] --out DIR [options]

Says how far each normal of SCAN (PLY, PCD, VTK or text) may be off; without SCAN, of a simulated
kitchen, and whether that is true. Writes normals.ply, with the standard deviation of each normal in
degrees, and uncertainty.png into DIR.

  --k N           neighbors per point (30)
  --sigma M       standard deviation of the range (0.015)
  --threads N     0 for all there are (0)
  --help          this text
)";

struct options {
    std::string scan;  ///< path, or empty for the simulated kitchen
    std::string out;
    std::size_t k = 30;
    double sigma = 0.015;
    gnomon::threads threads;
};

inline constexpr option<options> known_options[] = {
    common::out<options>,
    common::k<options>,
    common::sigma<options>,
    common::threads<options>,
};

/// The options on the command line, or nothing if they include --help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    return options_from<options>(words, known_options, take_scan<options>);
}
