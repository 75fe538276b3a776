// SPDX-License-Identifier: BSL-1.0
// Fig. 4.12: three trajectories through one room, in which a column stands before the far wall.
#include "rooms.hpp"

int main(int argc, char** argv) {
    return run_program(argc, argv, [](const effort& much) -> json {
        std::vector<dataset> scans;
        for (const char trajectory : {'H', 'V', 'R'}) {
            scans.push_back(dataset_of(std::string("Two Chairs ") + trajectory));
            const gnomon::simulation::true_scan truth = scans.back().scan(1);
            draw(truth, perceive(truth),
                 much.out / (std::string("fig_4_12_") + trajectory + ".png"));
        }
        return {{"surfaces",
                 recovery_table(scans,
                                {"room/wall +x/plane", "room/wall -y/plane", "room/wall +y/plane",
                                 "column/body/-x", "chair 1/seat/+z", "chair 2/seat/+z"},
                                much)}};
    });
}
