// SPDX-License-Identifier: BSL-1.0
// Which segments of a room are one surface behind an occluder, and how long does each step take?
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Merges the surfaces of a simulated kitchen behind occluders, and prints the "
                     "time of each step."))
        return 0;
    // A kitchen, seen by a laser range finder that rolls about its viewing direction.
    const gnomon::simulation::scene kitchen = gnomon::simulation::scenes::kitchen();
    const gnomon::simulation::rotational trajectory{.mount = kitchen.sensor};
    const gnomon::scan scan =
        gnomon::simulation::simulate(kitchen, trajectory, {}, {.sigma = 0.015}).scan;

    // [merge_surfaces]
    const gnomon::perception<> chain;  // the noise is measured, thresholds follow from it
    const auto seen = chain(scan, gnomon::threads{});

    std::printf("noise of %.1f mm at 2 m\n", 1000.0 * seen.noise.curve(2.0));
    std::printf("%zu segments before merging, %zu surfaces\n", seen.initial_segments.size(),
                seen.surfaces.size());
    for (const gnomon::considered_gap& gap : seen.gaps) {
        std::printf("a gap of %.2f m, %zu of %zu places in it occluded: %s\n", gap.width(),
                    gap.seen[gnomon::observation::occluded], gap.seen.total(),
                    gap.merged ? "closed" : "left open");
    }
    // [merge_surfaces]
    for (const auto& step : seen.steps)
        std::printf("%-20s %.3f s\n", step.name.data(), step.seconds);
    std::printf("%-20s %.3f s\n", "all steps", seen.seconds());

    // [thesis_chain]
    const gnomon::perception<gnomon::knn, gnomon::plane_pca, gnomon::conservative,
                             gnomon::smooth_surfaces>
        of_the_thesis{.noise = gnomon::constant_noise{0.015}};
    const auto seen_so = of_the_thesis(scan, gnomon::threads{});
    // [thesis_chain]
    std::printf("the chain of the thesis: %zu segments before merging, %zu surfaces\n",
                seen_so.initial_segments.size(), seen_so.surfaces.size());
}
