// SPDX-License-Identifier: BSL-1.0
/// @file
/// What the programs of all figures and tables share: how much is measured, how long it takes, and
/// how rows are filled. Each is a program of Google Benchmark, of which each row is a benchmark;
/// figure.cpp has main().
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

/// How much is measured.
struct effort {
    bool quick = false;
    std::map<std::string, std::uint64_t> numbers = {};  ///< of --NAME=NUMBER
    mutable std::set<std::string> asked = {};           ///< names that the program knows

    [[nodiscard]] std::uint64_t seeds() const { return quick ? 2 : 5; }
    [[nodiscard]] int passes() const { return quick ? 2 : 15; }
    /// All values of a parameter, or the few that must do.
    template <class T>
    [[nodiscard]] std::vector<T> of(std::vector<T> all, std::vector<T> few) const {
        return quick ? few : all;
    }
    /// The number of --NAME=NUMBER; without it, `all` or the few that must do.
    [[nodiscard]] std::uint64_t number(const std::string& name, std::uint64_t all,
                                       std::uint64_t few) const {
        asked.insert(name);
        const auto given = numbers.find(name);
        return given != numbers.end() ? given->second : quick ? few : all;
    }
};

/// Each program says what it measures.
void enter_benchmarks(const effort& much);

/// Seconds of processor time that a call takes.
double seconds_of(const std::function<void()>& work);

struct quartiles {
    double low, median, high;
};
/// @throws std::invalid_argument  if there are none
quartiles quartiles_of(std::vector<double> values);

/// The value made last, and for what.
template <class T>
class latest {
  public:
    const T& operator()(const std::string& name, const auto& make) {
        if (!value_ || name_ != name) {
            value_.reset();
            value_.emplace(make());
            name_ = name;
        }
        return *value_;
    }

  private:
    std::string name_;
    std::optional<T> value_;
};

/// A counter of a mean over seeds, and one of each seed: NAME, NAME_1, NAME_2, ...
void count_seeds(benchmark::State& state, const std::string& name,
                 const std::vector<double>& of_seeds);
