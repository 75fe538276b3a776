// SPDX-License-Identifier: BSL-1.0
// Fig. 3.14: the surface types of the dense rotational scan of the kitchen, by the thesis's fit and
// by the shape operator. Everything there is flat; points with a neighbor of another surface see an
// edge, and are left out.
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "measure.hpp"
#include <gnomon/features.hpp>
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

constexpr std::size_t types = 9;
using type_shares = std::array<double, types>;  ///< of the points, in percent

struct prepared_scan {
    sim::true_scan truth;
    gnomon::adjacency graph;
    std::vector<gnomon::surfel<gnomon::plane_fit>> surface;

    prepared_scan(const sim::scanner& finder, double sigma, std::uint64_t seed, std::size_t k) {
        const gnomon::threads all{};
        const sim::scene world = sim::scenes::kitchen();
        truth = sim::simulate(world, sim::rotational{.mount = world.sensor}, finder,
                              {.sigma = sigma, .seed = seed}, all);
        graph = gnomon::knn{.k = k}(truth.scan, all);
        surface = gnomon::estimate_normals(truth.scan, graph, gnomon::plane_pca{}, all);
        gnomon::orient_normals(truth.scan, surface);
    }

    [[nodiscard]] bool sees_no_edge(std::size_t i) const {
        return std::all_of(graph[i].begin(), graph[i].end(), [&](gnomon::point_index j) {
            return truth.surfaces[j] == truth.surfaces[i];
        });
    }

    [[nodiscard]] type_shares shares(const auto& fit, const gnomon::besl_jain& type) const {
        const auto curvatures =
            gnomon::estimate_curvature(truth.scan, graph, surface, fit, gnomon::threads{});
        type_shares counts{};
        double all = 0.0;
        for (std::size_t i = 0; i < curvatures.size(); ++i) {
            if (!sees_no_edge(i)) continue;
            ++counts[static_cast<std::size_t>(type(curvatures[i]))];
            ++all;
        }
        for (double& count : counts) count *= 100.0 / all;
        return counts;
    }
};

/// Of the types, in bits.
double entropy(const type_shares& shares) {
    double bits = 0.0;
    for (const double s : shares) {
        if (s > 0.0) bits -= 0.01 * s * std::log2(0.01 * s);
    }
    return bits;
}

void count(benchmark::State& state, const std::vector<type_shares>& of_seeds) {
    const auto counter = [&](const std::string& name, const auto& value) {
        std::vector<double> values;
        for (const type_shares& shares : of_seeds) values.push_back(value(shares));
        count_seeds(state, name, values);
    };
    const auto share = [](gnomon::surface_type t) {
        return [t](const type_shares& s) { return s[static_cast<std::size_t>(t)]; };
    };
    using gnomon::surface_type;
    counter("flat", share(surface_type::flat));
    counter("saddle_ridge", share(surface_type::saddle_ridge));
    counter("saddle_valley", share(surface_type::saddle_valley));
    counter("majority", [](const type_shares& s) { return *std::max_element(s.begin(), s.end()); });
    counter("entropy_bits", entropy);
    for (std::size_t t = 0; t < types; ++t) {
        double sum = 0.0;
        for (const type_shares& s : of_seeds) sum += s[t];
        state.counters[std::string("share_") + to_string(static_cast<surface_type>(t))] =
            sum / static_cast<double>(of_seeds.size());
    }
}

latest<std::vector<prepared_scan>> latest_scans;

}  // namespace

void enter_benchmarks(const effort& much) {
    const sim::scanner finder = much.quick ? sim::densities::medium() : sim::densities::high();
    const auto cell = [&](int sigma_mm, std::size_t k, const char* tolerance,
                          const gnomon::besl_jain& type) {
        const std::uint64_t seeds = sigma_mm > 0 ? much.seeds() : 1;
        const auto fit = [&](const char* name, const auto& estimate) {
            const std::string of_scans =
                "fig_3_14/sigma_mm:" + std::to_string(sigma_mm) + "/k:" + std::to_string(k);
            const std::string title = of_scans + "/tolerance:" + tolerance + "/fit:" + name;
            benchmark::RegisterBenchmark(
                title.c_str(),
                [=](benchmark::State& state) {
                    const auto& scans = latest_scans(of_scans, [&] {
                        std::vector<prepared_scan> all;
                        for (std::uint64_t seed = 1; seed <= seeds; ++seed)
                            all.emplace_back(finder, 1e-3 * sigma_mm, seed, k);
                        return all;
                    });
                    std::vector<type_shares> of_seeds;
                    for (auto _ : state) {
                        for (const prepared_scan& scan : scans)
                            of_seeds.push_back(scan.shares(estimate, type));
                    }
                    count(state, of_seeds);
                })
                ->Iterations(1)
                ->Unit(benchmark::kMillisecond);
        };
        fit("thesis", gnomon::thesis_curvature{});
        fit("shape operator", gnomon::shape_operator_curvature{});
    };
    const gnomon::besl_jain zero{};
    // Without noise curvatures err by 1e-12 / m, by rounding; radii over 1 km are flat.
    const gnomon::besl_jain rounding{.gaussian_tolerance = 1e-6, .mean_tolerance = 1e-3};
    cell(0, 50, "zero", zero);
    cell(0, 50, "rounding", rounding);
    for (const int sigma_mm : much.of<int>({15, 30}, {15})) {
        for (const std::size_t k : much.of<std::size_t>({50, 100, 200}, {50, 100}))
            cell(sigma_mm, k, "zero", zero);
    }
}
