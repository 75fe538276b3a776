// SPDX-License-Identifier: BSL-1.0
// Fig. 4.9: the segments of the rotational scan of the kitchen; and how often the seats that few
// scan lines meet are one, over more seeds than five.
#include <algorithm>
#include <array>
#include <vector>

#include "rooms.hpp"

namespace {

json seats_of_many(const dataset& kitchen, const effort& much) {
    constexpr std::array seats{"chair 1/seat/+z", "chair 4/seat/+z"};
    const unsigned seeds = much.quick ? 1 : 20;
    std::array<std::vector<double>, seats.size()> iou;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        const gnomon::simulation::true_scan truth = kitchen.scan(seed);
        const perceived seen = perceive(truth);
        for (std::size_t s = 0; s < seats.size(); ++s)
            iou[s].push_back(recovery_of(truth, seen, kitchen.world.find_surface(seats[s])).iou);
    }
    json rows = json::array();
    for (std::size_t s = 0; s < seats.size(); ++s)
        rows.push_back({{"surface", seats[s]},
                        {"seeds", seeds},
                        {"of them with an IoU of 0.8",
                         std::ranges::count_if(iou[s], [](double x) { return x >= 0.8; })},
                        {"median IoU", rounded(median_of(iou[s]), 3)},
                        {"least IoU", rounded(std::ranges::min(iou[s]), 3)}});
    return rows;
}

json measure(const effort& much) {
    const dataset kitchen = dataset_of("Kitchen R");
    const gnomon::simulation::true_scan truth = kitchen.scan(1);
    draw(truth, perceive(truth), much.out / "fig_4_9.png");
    return {{"surfaces", recovery_table({kitchen},
                                        {"room/wall +x/plane", "room/wall -y/plane",
                                         "room/wall +y/plane", "sink cabinet/body/-x",
                                         "sink cabinet/body/+z", "cupboard/body/-x", "table/top/+z",
                                         "chair 1/seat/+z", "chair 2/seat/+z", "chair 4/seat/+z"},
                                        much)},
            {"seats that few scan lines meet, over more seeds", seats_of_many(kitchen, much)}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
