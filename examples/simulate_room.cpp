// SPDX-License-Identifier: BSL-1.0
// How good are normals where the truth is known?
#include <cstdio>

#include <gnomon/gnomon.hpp>
#include <gnomon/simulation.hpp>

int main() {
    // [simulate_room]
    gnomon::scene world = gnomon::scenes::kitchen();
    world.add_object("lamp", gnomon::cone{0.20, 0.25}, gnomon::at(2.2, -0.2, 1.5));

    const gnomon::true_scan truth =
        gnomon::simulate(world, gnomon::rotational{.mount = world.sensor},
                         gnomon::scanners::hokuyo_utm_30lx(), {.sigma = 0.015, .seed = 1});

    const auto surface = gnomon::estimate_normals(truth.scan, gnomon::knn{}, gnomon::plane_pca{});
    std::printf("gamma = %.3f\n", gnomon::mean_gamma(surface, truth.normals));
    // [simulate_room]
    return 0;
}
