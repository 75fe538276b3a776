// SPDX-License-Identifier: BSL-1.0
// Which estimator on which graph, at which k, for which noise? The rotational scan of the kitchen,
// 28,800 points, with the methods of the thesis and three beyond it.
#include <string>

#include "measure.hpp"

void enter_benchmarks(const effort& much) {
    auto all = thesis_methods();
    for (const method& m : methods({"ray_ls", "weighted_pca", "robust_pca"})) all.push_back(m);
    const auto fans = methods({"area_weighted", "angle_weighted"});
    const int passes = much.quick ? 1 : 5;
    for (const int sigma_mm : much.of<int>({0, 5, 15, 30}, {0, 15})) {
        const cloud_condition scan{.name = "sigma_mm:" + std::to_string(sigma_mm),
                                   .sigma = 1e-3 * sigma_mm,
                                   .seeds = sigma_mm > 0 ? much.seeds() : 1,
                                   .make = kitchen("rotational", 28800, 1e-3 * sigma_mm)};
        for (const std::size_t k : much.of<std::size_t>({10, 20, 30, 50}, {10, 30}))
            enter("decision", scan, knn_graph(k), all, passes);
        for (const std::size_t k : much.of<std::size_t>({10, 30}, {30}))
            enter("decision", scan, angularly_sorted_knn_graph(k), fans, passes);
        enter("decision", scan, delaunay_graph(),
              methods({"plane_svd", "plane_pca", "vector_svd", "area_weighted", "angle_weighted"}),
              passes);
    }
}
