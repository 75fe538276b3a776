// SPDX-License-Identifier: BSL-1.0
// Fig. 4.10: the segments of the rotational scan of the living room; and the vase from scans with
// less noise and with smaller steps, to see what it would take to have it as one.
#include "rooms.hpp"

namespace {

/// The vase, as a scanner of `factor` times the density sees it.
json vase_row(const dataset& room, double sigma, unsigned factor) {
    const gnomon::scanner finder{.resolution = gnomon::degrees(0.25 / factor),
                                 .frequency = 40.0 * factor};
    const gnomon::true_scan truth =
        gnomon::simulate(room.world, gnomon::rotational{.mount = room.world.sensor}, finder,
                         {.sigma = sigma}, gnomon::threads{});
    const recovery vase =
        recovery_of(truth, perceive(truth), room.world.find_surface("vase/body/mantle"));
    return {{"noise [mm]", rounded(1e3 * sigma, 0)},
            {"points of the vase", vase.points},
            {"fragments", vase.fragments},
            {"IoU", rounded(vase.iou, 3)}};
}

json measure(const effort& much) {
    const dataset room = dataset_of("Living Room R");
    const gnomon::true_scan truth = room.scan(1);
    draw(truth, perceive(truth), much.out / "fig_4_10.png");
    json vase = json::array();
    for (const unsigned factor : much.quick ? std::vector{1u} : std::vector{1u, 2u, 3u})
        for (const double sigma : {0.015, 0.0}) vase.push_back(vase_row(room, sigma, factor));
    return {
        {"surfaces",
         recovery_table({room},
                        {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane",
                         "platform/body/+z", "sideboard/body/-x", "small table/top/+z",
                         "armchair 1/arm right/-y", "armchair 2/arm left/+y", "vase/body/mantle"},
                        much)},
        {"vase", vase}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
