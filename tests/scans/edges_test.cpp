// SPDX-License-Identifier: BSL-1.0
// Near the edges of the kitchen, where a neighborhood holds points of two surfaces: estimators that
// listen more to the near neighbors gain there (specification F4).
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scans/sampled_rings.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace {

TEST(edges, near_neighbors_tell_more) {
    const gnomon::scene world = gnomon::scenes::kitchen();
    for (const double sigma : {0.0, 0.005}) {
        const auto truth = gnomon::simulate(world, gnomon::rotational{.mount = world.sensor},
                                            gnomon::densities::high(), {.sigma = sigma, .seed = 1});
        auto rings = sampled::rings_of(truth.scan, gnomon::knn{.k = 60}, 4);
        // Of these, within twice the neighborhood there is another surface.
        std::erase_if(rings, [&](const sampled::ring& r) {
            return std::ranges::all_of(r.neighbors, [&](const gnomon::neighbor& q) {
                return std::abs(truth.normals[q.index].dot(truth.normals[r.point])) >= 0.9;
            });
        });
        ASSERT_GT(rings.size(), 3000u);
        EXPECT_GT(sampled::mean_gamma(gnomon::weighted_pca{}, truth, rings, 30),
                  sampled::mean_gamma(gnomon::plane_pca{}, truth, rings, 30) + 0.01)
            << "sigma = " << sigma;
    }
}

}  // namespace
