// SPDX-License-Identifier: BSL-1.0
// Fig. 4.10: the segments of the rotational scan of the living room; and two surfaces from
// scans with less noise and with smaller steps, to see what keeps them from being one.
#include "rooms.hpp"

namespace {

/// A surface, as a scanner of `factor` times the beams and scan lines sees it.
json row_of(const dataset& room, const char* surface, double sigma, unsigned factor) {
    const gnomon::scanner finder{.resolution = gnomon::degrees(0.25 / factor),
                                 .frequency = 40.0 * factor};
    const gnomon::true_scan truth =
        gnomon::simulate(room.world, gnomon::rotational{.mount = room.world.sensor}, finder,
                         {.sigma = sigma}, gnomon::threads{});
    const recovery r = recovery_of(truth, perceive(truth), room.world.find_surface(surface));
    return {{"surface", surface},
            {"noise [mm]", rounded(1e3 * sigma, 0)},
            {"points", r.points},
            {"fragments", r.fragments},
            {"IoU", rounded(r.iou, 3)}};
}

json measure(const effort& much) {
    const dataset room = dataset_of("Living Room R");
    const gnomon::true_scan truth = room.scan(1);
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
        {"what noise and density make of two of them", limits}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
