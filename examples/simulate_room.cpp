// SPDX-License-Identifier: BSL-1.0
// How good are normals where the truth is known?
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Prints the quality of the normals of a simulated scan."))
        return 0;
    // [simulate_room]
    namespace sim = gnomon::simulation;

    sim::scene world = sim::scenes::kitchen();
    world.add_object("lamp", sim::cone{0.20, 0.25}, sim::at(2.2, -0.2, 1.5));

    const sim::true_scan truth =
        sim::simulate(world, sim::rotational{.mount = world.sensor},
                      sim::scanners::hokuyo_utm_30lx(), {.sigma = 0.015, .seed = 1});

    const auto surface = gnomon::estimate_normals(truth.scan, gnomon::knn{}, gnomon::plane_pca{});
    std::printf("gamma = %.3f\n", gnomon::mean_gamma(surface, truth.normals));
    // [simulate_room]
    return 0;
}
