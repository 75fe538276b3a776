// SPDX-License-Identifier: BSL-1.0
#include "figure.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <ctime>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>

double seconds_of(const std::function<void()>& work) {
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

quartiles quartiles_of(std::vector<double> values) {
    if (values.empty()) throw std::invalid_argument("quartiles of nothing");
    std::sort(values.begin(), values.end());
    const std::size_t last = values.size() - 1;
    return {values[last / 4], values[last / 2], values[last - last / 4]};
}

void count_seeds(benchmark::State& state, const std::string& name,
                 const std::vector<double>& of_seeds) {
    double sum = 0.0;
    for (std::size_t i = 0; i < of_seeds.size(); ++i) {
        sum += of_seeds[i];
        state.counters[name + "_" + std::to_string(i + 1)] = of_seeds[i];
    }
    state.counters[name] = sum / static_cast<double>(of_seeds.size());
}

namespace {

/// What the system calls its processor.
std::string processor() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    }
    return "unknown";
}

/// A word --NAME=NUMBER.
std::optional<std::pair<std::string, std::uint64_t>> named_number(std::string_view word) {
    const std::size_t equals = word.find('=');
    if (!word.starts_with("--") || equals == word.npos) return std::nullopt;
    std::uint64_t number = 0;
    const char* const end = word.data() + word.size();
    const auto [rest, error] = std::from_chars(word.data() + equals + 1, end, number);
    if (error != std::errc() || rest != end) return std::nullopt;
    return std::pair(std::string(word.substr(2, equals - 2)), number);
}

}  // namespace

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    effort much;
    std::string unknown;
    for (int i = 1; i < argc; ++i) {
        const std::string_view word = argv[i];
        if (word == "--quick")
            much.quick = true;
        else if (const auto number = named_number(word))
            much.numbers.insert(*number);
        else
            unknown = word;
    }
    enter_benchmarks(much);
    for (const auto& [name, number] : much.numbers)
        if (!much.asked.contains(name)) unknown = "--" + name;
    if (!unknown.empty()) {
        std::string numbers;
        for (const std::string& name : much.asked) numbers += "[--" + name + "=NUMBER] ";
        std::fprintf(stderr,
                     "%s: unknown word %s\nusage: %s [--quick] %s[options of Google Benchmark, "
                     "such as --benchmark_filter=REGEX, --benchmark_out=FILE]\n",
                     argv[0], unknown.c_str(), argv[0], numbers.c_str());
        return 2;
    }
    benchmark::AddCustomContext("quick", much.quick ? "true" : "false");
    benchmark::AddCustomContext("processor", processor());
    benchmark::AddCustomContext("compiler", FIGURE_COMPILER);
    benchmark::AddCustomContext("flags", FIGURE_FLAGS);
    benchmark::RunSpecifiedBenchmarks();
}
