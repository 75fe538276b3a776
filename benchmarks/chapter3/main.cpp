// SPDX-License-Identifier: BSL-1.0
// The main program of all figures: options, and the description of the machine.
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include <benchmark/benchmark.h>

#include "../../examples/common/help.hpp"
#include "measure.hpp"

namespace {

/// What the system calls its processor.
std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

}  // namespace

int main(int argc, char** argv) {
    const char* const arguments =
        " [--quick] [options of Google Benchmark, such as --benchmark_filter=REGEX, "
        "--benchmark_out=FILE]";
    if (printed_help(argc, argv, "Measures, and prints a table; --quick: of fewer scans.",
                     arguments))
        return 0;
    std::vector<char*> words(argv, argv + argc);
    const auto is_quick = [](const char* word) { return std::string_view(word) == "--quick"; };
    const effort much{.quick = std::erase_if(words, is_quick) > 0};
    int left = static_cast<int>(words.size());
    words.push_back(nullptr);
    benchmark::Initialize(&left, words.data());
    if (left > 1) {
        std::fprintf(stderr, "%s: unknown word %s\n%s", argv[0], words[1],
                     usage_of(argv[0], arguments).c_str());
        return 2;
    }
    benchmark::AddCustomContext("quick", much.quick ? "true" : "false");
    benchmark::AddCustomContext("processor", processor());
    benchmark::AddCustomContext("compiler", CHAPTER3_COMPILER);
    benchmark::AddCustomContext("flags", CHAPTER3_FLAGS);
    enter_benchmarks(much);
    benchmark::RunSpecifiedBenchmarks();
}
