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
    {"--out", true,
     [](options& o, const std::string&, const std::string& value) { o.out = value; }},
    {"--k", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.k = number_within<std::size_t>(name, value, 3, 10'000, "from 3 to 10,000");
     }},
    {"--delaunay", false,
     [](options& o, const std::string&, const std::string&) { o.delaunay = true; }},
    {"--sigma", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.sigma = number_within(name, value, 1e-6, 10.0, "from 1e-6 to 10");
     }},
    {"--seed", true,
     [](options& o, const std::string& name, const std::string& value) {
         constexpr std::uint64_t last = ~std::uint64_t{0};
         o.seed = number_within<std::uint64_t>(name, value, 0, last, "0 or more");
     }},
    {"--threads", true,
     [](options& o, const std::string& name, const std::string& value) {
         o.threads.n = threads_of(name, value);
     }},
};

/// The options that the words say, or nothing if they ask for help.
/// @throws usage_error  if there is a word that makes no sense
inline std::optional<options> options_from(const std::vector<std::string>& words) {
    auto o = options_from<options>(words, known_options, [](options& set, const std::string& word) {
        if (!set.scan.empty()) throw usage_error("one scan at a time, please: " + word);
        set.scan = word;
    });
    if (o && o->out.empty()) throw usage_error("--out DIR is missing");
    return o;
}
