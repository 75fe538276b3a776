// SPDX-License-Identifier: BSL-1.0
// How do I search once and use it everywhere? The index is built once, stands for the points in
// every algorithm, and answers questions of one's own.
#include <cmath>
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Builds one index for several algorithms.")) return 0;
    const auto truth = gnomon::simulation::simulate(gnomon::simulation::box_and_cylinder{});
    const gnomon::scan& scan = truth.scan;
    // [use_index]
    gnomon::spatial_index index(scan, gnomon::threads{});

    // In place of the points: no algorithm builds an index of its own.
    const auto surface = gnomon::estimate_normals(index, gnomon::knn{.k = 20}, gnomon::plane_pca{});
    const auto parts = gnomon::segment_surfaces(index, surface);
    const auto clusters = gnomon::euclidean_clusters(index, {.radius = 0.05, .min_points = 100});
    std::printf("%zu surfaces, %zu clusters\n", parts.size(), clusters.size());

    // Questions at any position, answered nearest first.
    const Eigen::Vector3d position = scan.points.front() + Eigen::Vector3d(0.0, 0.0, 0.01);
    for (const gnomon::neighbor& q : index.nearest(position, 3))
        std::printf("point %u at %.4f m\n", q.index, std::sqrt(q.squared_distance));
    std::printf("%zu points within 5 cm\n", index.within(position, 0.05).size());
    const auto manhattan =
        index.nearest_within(position, 10, 0.05, {.metric = gnomon::metric::manhattan()});
    std::printf("%zu by the Manhattan distance, 10 at most\n", manhattan.size());

    // Among the points of the first surface only.
    const auto first = index.subset(parts[0]);
    std::printf("%zu of surface 0\n", first.within(position, 0.05).size());

    index.rebuild(scan);  // of the next scan, in the same memory
    // [use_index]
}
