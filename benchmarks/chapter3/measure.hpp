// SPDX-License-Identifier: BSL-1.0
/// @file
/// How a cell of a figure is measured: a method on a graph of a cloud, as a benchmark whose
/// counters hold the quality beside the time.
///
/// Quality is that of several seeds, their mean and each; times are of the first, on one thread, by
/// the processor's clock, which does not run while others have the processor. A pass is all normals
/// of a cloud; what is said of passes is their median, with the quartiles for the spread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "clouds.hpp"
#include "figure.hpp"
#include "methods.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/neighborhoods/adjacency.hpp>

/// A kind of cloud. Names are made of "key:value" parts.
struct cloud_condition {
    std::string name;
    double sigma = 0.0;  ///< of the range [m]
    std::uint64_t seeds = 1;
    cloud_source make;
    /// If not 0, up to this k the k nearest neighbors of all seeds but the first, whose search is
    /// timed, are cut from the lists of so many, instead of being searched for again.
    std::size_t widest_k = 0;
};

/// A kind of graph.
struct graph_condition {
    std::string name;
    std::function<gnomon::adjacency(const gnomon::scan&, const gnomon::threads&)> make;
    std::size_t k = 0;  ///< of the k nearest neighbors by distance, if it is that graph
};
graph_condition knn_graph(std::size_t k);
graph_condition sorted_knn_graph(std::size_t k);  ///< in angular order
graph_condition delaunay_graph();

/// Registers a benchmark "figure/cloud/graph/method:name" for each method. Clouds and graphs are
/// kept until others are asked for: enter those of one cloud together.
/// @param passes  that are timed
void enter(const std::string& figure, const cloud_condition& cloud, const graph_condition& graph,
           const std::vector<method>& how, int passes);
