// SPDX-License-Identifier: BSL-1.0
// Noise along the rays is what range finders have: an estimator that knows it is ahead of one that
// does not, on dense scans of the kitchen, whichever way the scanner moves. The whole table is
// printed by benchmarks/normals/ray_ls_against_plane_pca.
#include <cstddef>

#include <gtest/gtest.h>

#include "scans/sampled_neighborhoods.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// Gains in mean gamma at every eighth point, from the k nearest neighbors, for three k at once.
void expect_ahead(const auto& trajectory, const sim::scene& world, double sigma) {
    const auto truth =
        sim::simulate(world, trajectory, sim::densities::high(), {.sigma = sigma, .seed = 1});
    const auto neighborhoods = sampled::neighborhoods_of(truth.scan, gnomon::knn{.k = 50}, 8);
    for (const std::size_t k : {15u, 30u, 50u}) {
        EXPECT_GT(sampled::mean_gamma(gnomon::ray_ls{}, truth, neighborhoods, k),
                  sampled::mean_gamma(gnomon::plane_pca{}, truth, neighborhoods, k))
            << "k = " << k << " sigma = " << sigma;
    }
}

TEST(ray_ls_on_kitchen, is_ahead_of_plane_pca_on_dense_scans_with_noise) {
    const sim::scene world = sim::scenes::kitchen();
    for (const double sigma : {0.015, 0.030}) {
        expect_ahead(sim::horizontal{.mount = world.sensor}, world, sigma);
        expect_ahead(sim::vertical{.mount = world.sensor}, world, sigma);
        expect_ahead(sim::rotational{.mount = world.sensor}, world, sigma);
    }
}

}  // namespace
