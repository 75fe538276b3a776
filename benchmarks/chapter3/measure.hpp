// SPDX-License-Identifier: BSL-1.0
/// @file
/// The measurement of a cell of a figure: a method on a graph of a cloud, as a benchmark with the
/// quality in its counters.
///
/// Quality is that of several seeds, their mean and each; times are of the first, on one thread, by
/// the processor's clock, which does not run while others have the processor. A pass is all normals
/// of a cloud; the time is the median over passes, with the quartiles as spread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "clouds.hpp"
#include "methods.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>

/// How much is measured.
struct effort {
    bool quick = false;

    [[nodiscard]] std::uint64_t seeds() const { return quick ? 2 : 5; }
    [[nodiscard]] int passes() const { return quick ? 2 : 15; }
    /// All values of a parameter, or the few that must do.
    template <class T>
    [[nodiscard]] std::vector<T> of(std::vector<T> all, std::vector<T> few) const {
        return quick ? few : all;
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

/// A kind of cloud. Names are made of "key:value" parts.
struct cloud_condition {
    std::string name;
    double sigma = 0.0;  ///< of the range [m]
    std::uint64_t seeds = 1;
    cloud_source make;
    /// If not 0, graphs of all seeds but the first, whose search is timed, are truncated from one
    /// search for this number of neighbors. Performance only.
    std::size_t widest_k = 0;
};

/// A kind of graph.
struct graph_condition {
    std::string name;
    std::function<gnomon::adjacency(const gnomon::scan&, const gnomon::threads&)> make;
    std::size_t k = 0;  ///< of the k nearest neighbors by distance, if it is that graph
};
graph_condition knn_graph(std::size_t k);
graph_condition angularly_sorted_knn_graph(std::size_t k);
graph_condition delaunay_graph();

/// Registers a benchmark "figure/cloud/graph/method:name" for each method. The last
/// cloud and graph are cached: enter the methods of one cloud together.
/// @param passes  that are timed
void enter(const std::string& figure, const cloud_condition& cloud, const graph_condition& graph,
           const std::vector<method>& how, int passes);

/// A counter of a mean over seeds, and one of each seed: NAME, NAME_1, NAME_2, ...
void count_seeds(benchmark::State& state, const std::string& name,
                 const std::vector<double>& of_seeds);
