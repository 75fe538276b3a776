// SPDX-License-Identifier: BSL-1.0
// Near the edges of the kitchen, where a neighborhood holds points of two surfaces: estimators that
// listen more to the near neighbors gain there (specification F4).
#include <cmath>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

TEST(edges, near_neighbors_tell_more) {
    const gnomon::scene world = gnomon::scenes::kitchen();
    for (const double sigma : {0.0, 0.005}) {
        const auto truth = gnomon::simulate(world, gnomon::rotational{.mount = world.sensor},
                                            gnomon::densities::high(), {.sigma = sigma, .seed = 1});
        const auto& points = truth.scan.points;
        const auto search = gnomon::knn{.k = 60}.search(points);
        double weighted = 0.0;
        double plain = 0.0;
        int edges = 0;
        std::vector<gnomon::neighbor> found;
        std::vector<Eigen::Vector3d> ring;
        for (std::size_t i = 0; i < points.size(); i += 4) {
            search(i, found);
            // Within twice the neighborhood there is another surface.
            bool edge = false;
            for (const auto& q : found)
                edge = edge || std::abs(truth.normals[q.index].dot(truth.normals[i])) < 0.9;
            if (!edge) continue;
            ++edges;
            ring.clear();
            for (std::size_t j = 0; j < 30; ++j) ring.push_back(points[found[j].index]);
            weighted +=
                gnomon::gamma(gnomon::weighted_pca{}(points[i], ring).normal, truth.normals[i]);
            plain += gnomon::gamma(gnomon::plane_pca{}(points[i], ring).normal, truth.normals[i]);
        }
        ASSERT_GT(edges, 3000);
        EXPECT_GT(weighted / edges, plain / edges + 0.01) << "sigma = " << sigma;
    }
}

}  // namespace
