// SPDX-License-Identifier: BSL-1.0
// Fig. 3.5: seven methods on box and cylinder: quality, time and index over k (a-c), and over the
// noise on Delaunay stars (d). In addition, for its claims, k nearest neighbors
// at less noise, smaller and larger objects, and variants of the methods.
#include <string>
#include <vector>

#include "measure.hpp"

namespace {

const std::vector<std::string> linear_and_averaging{"plane_svd", "plane_pca", "vector_svd",
                                                    "area_weighted", "angle_weighted"};

cloud_condition objects(int sigma_mm, const std::string& scale, const effort& much) {
    return {.name = "sigma_mm:" + std::to_string(sigma_mm) + "/scale:" + scale,
            .sigma = 1e-3 * sigma_mm,
            .seeds = much.seeds(),
            .make = scenario_one(1e-3 * sigma_mm, std::stod(scale))};
}

}  // namespace

void enter_benchmarks(const effort& much) {
    const auto cell = [&](const cloud_condition& cloud, const graph_condition& graph,
                          const std::vector<method>& how) {
        enter("fig_3_5", cloud, graph, how, much.passes());
    };
    const auto five = methods(linear_and_averaging);

    // (a)-(c), with VectorPCA, which the thesis calls almost identical to PlanePCA
    const cloud_condition noisy = objects(15, "1", much);
    auto eight = thesis_methods();
    eight.push_back(methods({"vector_pca"})[0]);
    for (const std::size_t k :
         much.of<std::size_t>({10, 15, 20, 25, 30, 35, 40, 45, 50}, {10, 20, 30, 50})) {
        cell(noisy, knn_graph(k), eight);
    }
    cell(noisy, delaunay_graph(), five);  // (d)
    // the order of triangles
    cell(noisy, knn_graph(30),
         methods({"area_weighted to viewpoint", "angle_weighted to viewpoint"}));
    cell(noisy, angularly_sorted_knn_graph(30), methods({"area_weighted", "angle_weighted"}));

    for (const int sigma_mm : {1, 5, 10}) {
        const cloud_condition cloud = objects(sigma_mm, "1", much);
        cell(cloud, delaunay_graph(), five);
        if (sigma_mm == 1) continue;
        for (const std::size_t k : much.of<std::size_t>({20, 30, 40, 50}, {20, 50}))
            cell(cloud, knn_graph(k), five);
        if (sigma_mm == 5)  // the rank of QuadTransSVD
            cell(cloud, knn_graph(50), methods({"quad_trans_svd", "quad_trans_svd rank 6"}));
    }
    if (much.quick) return;
    for (const char* scale : {"0.85", "1.15"})
        cell(objects(15, scale, much), knn_graph(30), thesis_methods());
}
