// SPDX-License-Identifier: BSL-1.0
// Fig. 4.9: the segments of the rotational scan of the kitchen.
#include "rooms.hpp"

int main(int argc, char** argv) {
    return run_program(argc, argv, [](const effort& much) -> json {
        const dataset kitchen = dataset_of("Kitchen R");
        const gnomon::true_scan truth = kitchen.scan(1);
        draw(truth, perceive(truth), much.out / "fig_4_9.png");
        return {{"surfaces",
                 recovery_table(
                     {kitchen},
                     {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane",
                      "sink cabinet/body/-x", "sink cabinet/body/+z", "cupboard/body/-x",
                      "table/top/+z", "chair 1/seat/+z", "chair 2/seat/+z", "chair 4/seat/+z"},
                     much)}};
    });
}
