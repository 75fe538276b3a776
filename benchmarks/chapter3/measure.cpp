// SPDX-License-Identifier: BSL-1.0
#include "measure.hpp"

#include <algorithm>
#include <ctime>
#include <numeric>
#include <stdexcept>
#include <utility>

#include <gnomon/gnomon.hpp>

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

graph_condition knn_graph(std::size_t k) {
    return {"graph:knn/k:" + std::to_string(k),
            [k](const auto& scan, const auto& run) { return gnomon::knn{.k = k}(scan, run); }, k};
}

graph_condition angularly_sorted_knn_graph(std::size_t k) {
    return {"graph:angularly_sorted_knn/k:" + std::to_string(k),
            [k](const auto& scan, const auto& run) {
                return gnomon::angularly_sorted{gnomon::knn{.k = k}}(scan, run);
            }};
}

graph_condition delaunay_graph() {
    return {"graph:delaunay",
            [](const auto& scan, const auto& run) { return gnomon::delaunay{}(scan, run); }};
}

namespace {

/// The first k neighbors of each point.
gnomon::adjacency first_of(const gnomon::adjacency& graph, std::size_t k) {
    std::vector<std::uint64_t> begin{0};
    std::vector<gnomon::point_index> indices;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        const auto first = graph[i].first(std::min(k, graph[i].size()));
        indices.insert(indices.end(), first.begin(), first.end());
        begin.push_back(indices.size());
    }
    return {std::move(begin), std::move(indices)};
}

/// The clouds of all seeds.
struct clouds_of_seeds {
    std::vector<labeled_cloud> clouds;
    std::vector<gnomon::adjacency> widest;  ///< of all seeds but the first, if asked for
    std::size_t widest_k;

    explicit clouds_of_seeds(const cloud_condition& what) : widest_k(what.widest_k) {
        for (std::uint64_t seed = 1; seed <= what.seeds; ++seed) {
            clouds.push_back(what.make(seed));
            if (seed > 1 && widest_k > 0)
                widest.push_back(gnomon::knn{.k = widest_k}(clouds.back().scan, gnomon::threads{}));
        }
    }

    /// The graph on a cloud that is not the first.
    [[nodiscard]] gnomon::adjacency graph(const graph_condition& kind, std::size_t cloud) const {
        if (kind.k > 0 && kind.k <= widest_k) return first_of(widest[cloud - 1], kind.k);
        return kind.make(clouds[cloud].scan, gnomon::threads{});
    }
};

/// The graphs on them, and what the first took.
struct graphs_with_cost {
    std::vector<gnomon::adjacency> graphs;
    double seconds = 0.0;  ///< median of the searches
    double max_degree = 0.0;
    double mean_degree = 0.0;  ///< of the first

    graphs_with_cost(const graph_condition& what, const clouds_of_seeds& data, int passes) {
        std::vector<double> taken;
        gnomon::adjacency first;
        for (int pass = 0; pass < passes; ++pass) {
            taken.push_back(
                seconds_of([&] { first = what.make(data.clouds[0].scan, gnomon::threads{1}); }));
        }
        seconds = quartiles_of(taken).median;
        graphs.push_back(std::move(first));
        for (std::size_t c = 1; c < data.clouds.size(); ++c) graphs.push_back(data.graph(what, c));
        for (const gnomon::adjacency& graph : graphs) {
            for (std::size_t i = 0; i < graph.size(); ++i) {
                const auto degree = static_cast<double>(graph[i].size());
                max_degree = std::max(max_degree, degree);
                if (&graph == &graphs[0]) mean_degree += degree / static_cast<double>(graph.size());
            }
        }
    }
};

/// What one benchmark is about.
struct cell {
    cloud_condition cloud;
    graph_condition graph;
    method how;
    int passes;
};

void measure(benchmark::State& state, const cell& what) {
    static latest<clouds_of_seeds> latest_clouds;
    static latest<graphs_with_cost> latest_graphs;
    const clouds_of_seeds& data =
        latest_clouds(what.cloud.name, [&] { return clouds_of_seeds(what.cloud); });
    const auto& clouds = data.clouds;
    const auto& [graphs, search_seconds, max_degree, mean_degree] =
        latest_graphs(what.cloud.name + "/" + what.graph.name,
                      [&] { return graphs_with_cost(what.graph, data, std::min(what.passes, 5)); });
    std::vector<double> gamma, rms, median, p90, p99, usable;
    double with_truth = 0.0;
    for (std::size_t i = 0; i < clouds.size(); ++i) {
        const auto q = what.how.quality(clouds[i], graphs[i], what.cloud.sigma);
        gamma.push_back(q.gamma);
        rms.push_back(q.rms.degrees());
        median.push_back(q.median.degrees());
        p90.push_back(q.p90.degrees());
        p99.push_back(q.p99.degrees());
        usable.push_back(q.usable);
        with_truth = static_cast<double>(q.points);
    }
    std::vector<double> seconds;
    for (auto _ : state) {
        seconds.push_back(
            seconds_of([&] { what.how.pass(clouds[0], graphs[0], what.cloud.sigma); }));
    }

    const auto mean = [](const std::vector<double>& values) {
        return std::accumulate(values.begin(), values.end(), 0.0) /
               static_cast<double>(values.size());
    };
    const auto points = static_cast<double>(clouds[0].scan.size());
    const auto [low, fit, high] = quartiles_of(seconds);
    const double microseconds = 1e6 / points;
    count_seeds(state, "gamma", gamma);
    state.counters["rms_deg"] = mean(rms);
    state.counters["p50_deg"] = mean(median);
    state.counters["p90_deg"] = mean(p90);
    state.counters["p99_deg"] = mean(p99);
    state.counters["usable"] = mean(usable);
    state.counters["us"] = microseconds * fit;
    state.counters["us_with_search"] = microseconds * (fit + search_seconds);
    if (what.passes > 1) {
        state.counters["us_low"] = microseconds * low;
        state.counters["us_high"] = microseconds * high;
    }
    state.counters["pi_1us"] = gnomon::performance_index(mean(gamma), microseconds * fit, 1.0);
    state.counters["pi_01us"] = gnomon::performance_index(mean(gamma), microseconds * fit, 0.1);
    state.counters["points"] = points;
    if (with_truth < points) state.counters["points_with_truth"] = with_truth;
    state.counters["max_degree"] = max_degree;
    state.counters["mean_degree"] = mean_degree;
}

}  // namespace

void enter(const std::string& figure, const cloud_condition& cloud, const graph_condition& graph,
           const std::vector<method>& how, int passes) {
    for (const method& m : how) {
        const std::string name = figure + "/" + cloud.name + "/" + graph.name + "/method:" + m.name;
        const cell what{cloud, graph, m, passes};
        benchmark::RegisterBenchmark(name.c_str(),
                                     [what](benchmark::State& state) { measure(state, what); })
            ->Iterations(passes)
            ->Unit(benchmark::kMillisecond);
    }
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
