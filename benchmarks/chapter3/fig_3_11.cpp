// SPDX-License-Identifier: BSL-1.0
// Fig. 3.11: anisotropic neighborhoods in vertical scans of the kitchen: how many there are, what
// their normals are worth before and after the repair, and what it takes.
#include <string>
#include <vector>

#include "measure.hpp"
#include <gnomon/gnomon.hpp>

namespace {

using elements = std::vector<gnomon::surfel<gnomon::plane_fit>>;

struct repaired_cloud {
    double flagged_percent, gamma_before, gamma_after;  ///< of the flagged points
    double gamma_all_before, gamma_all_after;
};

repaired_cloud repaired(const labeled_cloud& cloud, const gnomon::knn& neighbors) {
    const gnomon::threads all{};
    const elements before =
        gnomon::estimate_normals(cloud.scan, neighbors, gnomon::plane_pca{}, all);
    elements after = before;
    gnomon::repair_anisotropic(cloud.scan, neighbors, after, gnomon::plane_pca{}, {}, all);
    repaired_cloud result{};
    double flagged = 0.0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        if (before[i].aspect_ratio() >= gnomon::repair_anisotropic_options{}.min_aspect_ratio)
            continue;
        ++flagged;
        result.gamma_before += gnomon::gamma(before[i].normal, cloud.normals[i]);
        result.gamma_after += gnomon::gamma(after[i].normal, cloud.normals[i]);
    }
    if (flagged > 0.0) {
        result.gamma_before /= flagged;
        result.gamma_after /= flagged;
    }
    result.flagged_percent = 100.0 * flagged / static_cast<double>(before.size());
    result.gamma_all_before = gnomon::mean_gamma(before, cloud.normals);
    result.gamma_all_after = gnomon::mean_gamma(after, cloud.normals);
    return result;
}

void measure(benchmark::State& state, const cloud_source& make, std::uint64_t seeds,
             const gnomon::knn& neighbors) {
    std::vector<double> flagged, before, after, all_before, all_after;
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
        const repaired_cloud r = repaired(make(seed), neighbors);
        flagged.push_back(r.flagged_percent);
        before.push_back(r.gamma_before);
        after.push_back(r.gamma_after);
        all_before.push_back(r.gamma_all_before);
        all_after.push_back(r.gamma_all_after);
    }
    const labeled_cloud cloud = make(1);
    std::vector<double> plain, repair;
    for (auto _ : state) {
        elements surface;
        plain.push_back(seconds_of([&] {
            surface = gnomon::estimate_normals(cloud.scan, neighbors, gnomon::plane_pca{},
                                               gnomon::threads{1});
        }));
        repair.push_back(seconds_of([&] {
            gnomon::repair_anisotropic(cloud.scan, neighbors, surface, gnomon::plane_pca{}, {},
                                       gnomon::threads{1});
        }));
    }
    count_seeds(state, "flagged_percent", flagged);
    count_seeds(state, "gamma_before", before);
    count_seeds(state, "gamma_after", after);
    count_seeds(state, "gamma_all_before", all_before);
    count_seeds(state, "gamma_all_after", all_after);
    const auto points = static_cast<double>(cloud.scan.size());
    state.counters["us_with_search"] = 1e6 * quartiles_of(plain).median / points;
    state.counters["us_repair"] = 1e6 * quartiles_of(repair).median / points;
    state.counters["points"] = points;
}

}  // namespace

void enter_benchmarks(const effort& much) {
    for (const int density : much.of<int>({7200, 28800, 115200}, {7200, 28800})) {
        for (const int sigma_mm : {0, 15}) {
            for (const std::size_t k : {15u, 30u, 50u}) {
                const std::string name = "fig_3_11/density:" + std::to_string(density) +
                                         "/sigma_mm:" + std::to_string(sigma_mm) +
                                         "/k:" + std::to_string(k);
                const auto make = kitchen("vertical", density, 1e-3 * sigma_mm);
                const std::uint64_t seeds = sigma_mm > 0 ? much.seeds() : 1;
                benchmark::RegisterBenchmark(
                    name.c_str(),
                    [=](benchmark::State& state) { measure(state, make, seeds, {.k = k}); })
                    ->Iterations(much.quick ? 3 : 5)
                    ->Unit(benchmark::kMillisecond);
            }
        }
    }
}
