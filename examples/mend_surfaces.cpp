// SPDX-License-Identifier: BSL-1.0
// Which surfaces of a room are one behind something, and how long does it take to find out?
#include <cstdio>

#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

int main() {
    // A kitchen, seen by a laser range finder that rolls about its axis of sight.
    const gnomon::scene kitchen = gnomon::scenes::kitchen();
    const gnomon::rotational trajectory{.mount = kitchen.sensor};
    const gnomon::scan scan = gnomon::simulate(kitchen, trajectory, {}, {.sigma = 0.015}).scan;

    // [mend_surfaces]
    const gnomon::perception chain{gnomon::knn{.k = 50},
                                   gnomon::plane_pca{},
                                   gnomon::conservative{},
                                   {.max_angle = gnomon::degrees(5)}};
    const auto seen = chain(scan, gnomon::threads{});

    std::printf("%zu fragments are %zu surfaces\n", seen.fragments.size(), seen.surfaces.size());
    for (const gnomon::considered_gap& gap : seen.gaps) {
        std::printf("a gap of %.2f m, %zu of %zu places in it hidden: %s\n",
                    gnomon::coplanar_distance(gap.lines), gap.seen[gnomon::sighting::closer],
                    gap.seen.total(), gap.merged ? "closed" : "left open");
    }
    // [mend_surfaces]
    std::printf("normals %.3f s, segmentation %.3f s, merging %.3f s\n", seen.seconds.normals,
                seen.seconds.segmentation, seen.seconds.merging);
}
