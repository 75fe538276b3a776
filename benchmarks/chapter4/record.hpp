// SPDX-License-Identifier: BSL-1.0
/// @file
/// The output of a program of this chapter: DIR/NAME.json, and pictures DIR/NAME*.png. The page
/// shows the tables of all programs in its list, so that a figure needs no code in the page:
///
///     {"context": {"quick": false, "processor": "...", "compiler": "...", "flags": "..."},
///      "tables": {"what these rows are": [{"column": value, ...}, ...]}}
#pragma once

#include <algorithm>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "../../examples/common/help.hpp"
#include <gnomon/io/output_file.hpp>

using json = nlohmann::ordered_json;

#ifndef BENCHMARK_COMPILER  // compiled by hand
#define BENCHMARK_COMPILER "GNU or clang " __VERSION__
#define BENCHMARK_FLAGS "unknown"
#endif

/// The extent of the measurement, and the folder for its results.
struct effort {
    bool quick = false;
    std::filesystem::path out;

    [[nodiscard]] unsigned seeds() const { return quick ? 1 : 5; }
    [[nodiscard]] int passes() const { return quick ? 1 : 7; }
};

/// The machine and the compiler, for the interpretation of times.
inline json context_of(const effort& much) {
    std::string processor = "unknown";
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (!line.starts_with("model name")) continue;
        const auto start = line.find_first_not_of(" \t:", line.find(':'));
        if (start != std::string::npos) processor = line.substr(start);
        break;
    }
    return {{"quick", much.quick},
            {"processor", processor},
            {"compiler", BENCHMARK_COMPILER},
            {"flags", BENCHMARK_FLAGS}};
}

/// Precondition: there are some.
inline double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// The probability that one of the first is below one of the second; equal ones count half. It is
/// the area under the ROC curve of a measure that is larger for the second. O(n log n).
inline double probability_of_less(const std::vector<double>& first, std::vector<double> second) {
    std::sort(second.begin(), second.end());
    double larger = 0.0;
    for (const double x : first) {
        const auto [low, high] = std::equal_range(second.begin(), second.end(), x);
        larger += static_cast<double>(second.end() - high) + 0.5 * static_cast<double>(high - low);
    }
    return larger / static_cast<double>(first.size()) / static_cast<double>(second.size());
}

/// Rounded to `digits` digits after the point.
inline double rounded(double value, int digits) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", digits, value);
    return std::stod(text);
}

/// A main program: NAME [--quick] --out DIR, where measure(effort) returns the tables. `more`
/// lists further options of the program.
int run_program(int argc, char** argv, auto&& measure, const std::string& more = "") {
    const std::string arguments = " [--quick]" + more + " --out DIR";
    if (printed_help(argc, argv, "Writes its tables into DIR; --quick: of fewer scans.", arguments))
        return 0;
    effort much;
    bool understood = true;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--quick")
            much.quick = true;
        else if (word == "--out" && i + 1 < argc)
            much.out = argv[++i];
        else
            understood = false;
    }
    const std::string name = std::filesystem::path(argv[0]).filename().string();
    if (!understood || much.out.empty()) {
        std::fputs(usage_of(argv[0], arguments).c_str(), stderr);
        return 2;
    }
    try {
        std::filesystem::create_directories(much.out);
        const json tables = measure(much);
        const json all{{"context", context_of(much)}, {"tables", tables}};
        gnomon::io::replace_file((much.out / (name + ".json")).string(), all.dump(1) + "\n");
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s: %s\n", name.c_str(), problem.what());
        return 1;
    }
    return 0;
}
