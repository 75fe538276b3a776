// SPDX-License-Identifier: BSL-1.0
// Near the edges of the kitchen, where neighborhoods hold points of two surfaces, estimators that
// give near neighbors larger weights have smaller errors.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "scans/sampled_neighborhoods.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(edges, weights_of_near_neighbors_reduce_errors) {
    const sim::scene world = sim::scenes::kitchen();
    for (const double sigma : {0.0, 0.005}) {
        const auto truth = sim::simulate(world, sim::rotational{.mount = world.sensor},
                                         sim::densities::high(), {.sigma = sigma, .seed = 1});
        auto neighborhoods = sampled::neighborhoods_of(truth.scan, gnomon::knn{.k = 60}, 4);
        // Of these, within twice the neighborhood there is another surface.
        std::erase_if(neighborhoods, [&](const sampled::neighborhood& r) {
            return std::ranges::all_of(r.neighbors, [&](const gnomon::neighbor& q) {
                return std::abs(truth.normals[q.index].dot(truth.normals[r.point])) >= 0.9;
            });
        });
        ASSERT_GT(neighborhoods.size(), 3000u);
        EXPECT_GT(sampled::mean_gamma(gnomon::weighted_pca{}, truth, neighborhoods, 30),
                  sampled::mean_gamma(gnomon::plane_pca{}, truth, neighborhoods, 30) + 0.01)
            << "sigma = " << sigma;
    }
}

}  // namespace
