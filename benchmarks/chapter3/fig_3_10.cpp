// SPDX-License-Identifier: BSL-1.0
// Fig. 3.10: PlanePCA on nine scans of the kitchen, at seven levels of noise, with twelve numbers
// of neighbors: 756 runs; and the sparse rotational scan with smaller and larger furniture.
#include <string>
#include <vector>

#include "measure.hpp"

void enter_benchmarks(const effort& much) {
    const auto pca = methods({"plane_pca"});
    const auto over_k = [&](const std::string& trajectory, int density, int sigma_mm,
                            const std::string& scale) {
        const cloud_condition scan{
            .name = "scan:" + trajectory + "/density:" + std::to_string(density) +
                    "/sigma_mm:" + std::to_string(sigma_mm) + "/scale:" + scale,
            .sigma = 1e-3 * sigma_mm,
            .seeds = sigma_mm > 0 ? much.seeds() : 1,  // without noise all seeds are the same
            .make = kitchen(trajectory, density, 1e-3 * sigma_mm, std::stod(scale)),
            .widest_k = 60};
        for (const std::size_t k : much.of<std::size_t>(
                 {5, 10, 15, 20, 25, 30, 35, 40, 45, 50, 55, 60}, {10, 20, 30, 60})) {
            enter("fig_3_10", scan, knn_graph(k), pca, 1);
        }
    };
    for (const int density : much.of<int>({7200, 28800, 115200}, {7200, 28800})) {
        for (const char* trajectory : {"horizontal", "vertical", "rotational"}) {
            for (const int sigma_mm : much.of<int>({0, 5, 10, 15, 20, 25, 30}, {0, 15, 30}))
                over_k(trajectory, density, sigma_mm, "1");
        }
    }
    if (much.quick) return;
    for (const char* scale : {"0.85", "1.15"}) {
        for (const int sigma_mm : {0, 5, 15, 30}) over_k("rotational", 7200, sigma_mm, scale);
    }
}
