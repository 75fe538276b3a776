// SPDX-License-Identifier: BSL-1.0
// Fig. 4.10: the segments of the rotational scan of the living room; and two surfaces in scans with
// less noise and with smaller angular steps, which shows why they are oversegmented.
#include "rooms.hpp"

namespace sim = gnomon::simulation;

namespace {

/// A surface, as a scanner of `factor` times the beams and scan lines sees it.
json row_of(const dataset& room, const char* surface, double sigma, unsigned factor) {
    const sim::scanner finder{.resolution = gnomon::degrees(0.25 / factor),
                              .frequency = 40.0 * factor};
    const sim::true_scan truth =
        sim::simulate(room.world, sim::rotational{.mount = room.world.sensor}, finder,
                      {.sigma = sigma}, gnomon::threads{});
    const recovery r = recovery_of(truth, perceive(truth), room.world.find_surface(surface));
    return {{"surface", surface},
            {"noise [mm]", rounded(1e3 * sigma, 0)},
            {"points", r.points},
            {"initial segments", r.initial_segments},
            {"IoU", rounded(r.iou, 3)}};
}

json measure(const effort& much) {
    const dataset room = dataset_of("Living Room R");
    const sim::true_scan truth = room.scan(1);
    draw(truth, perceive(truth), much.out / "fig_4_10.png");
    json limits = json::array();
    for (const char* surface : {"sideboard/body/-x", "vase/body/mantle"})
        for (const unsigned factor : much.quick ? std::vector{1u} : std::vector{1u, 2u})
            for (const double sigma : {0.015, 0.005, 0.0})
                limits.push_back(row_of(room, surface, sigma, factor));
    return {
        {"surfaces",
         recovery_table({room},
                        {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane",
                         "platform/body/+z", "sideboard/body/-x", "small table/top/+z",
                         "armchair 1/arm right/-y", "armchair 2/arm left/+y", "vase/body/mantle"},
                        much)},
        {"two of them by noise and density", limits}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
