// SPDX-License-Identifier: BSL-1.0
// The surfaces of random furnished rooms in images of a depth camera of structured light, whose
// depths come in steps. A true surface counts if it has 2 % of the points.
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <vector>

#include "../chapter4/record.hpp"
#include "furnished.hpp"
#include "perceived.hpp"
#include "scores.hpp"

namespace {

constexpr double recovered_from = 0.85;  // IoU

/// The image of a room.
struct image {
    std::uint64_t seed = 0;
    std::size_t points = 0, segments = 0;
    std::vector<recovered_surface> surfaces;
    double seconds = 0.0;
};

image image_of(std::uint64_t seed) {
    const sim::scene world = furnished(seed);
    const sim::true_scan truth = sim::simulate(
        world, world.sensor, sim::scanners::structured_light(), {.seed = 1000 * seed + 1});
    const auto start = std::chrono::steady_clock::now();
    const auto seen = perceive(truth.scan, false);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    const joined_surfaces surfaces(truth, seen.kept);
    const std::size_t fewest = truth.scan.size() / 50;
    return {seed, truth.scan.size(), seen.surfaces.size(),
            recovered(surfaces, seen.kept, seen.surfaces, fewest), taken.count()};
}

json row_of(json row, const std::vector<recovered_surface>& surfaces) {
    const auto well = std::ranges::count_if(
        surfaces, [](const recovered_surface& s) { return s.iou >= recovered_from; });
    const double share = surfaces.empty() ? 1.0 : double(well) / double(surfaces.size());
    row.update({{"surfaces", surfaces.size()},
                {"mean IoU", rounded(mean_iou(surfaces, false), 4)},
                {"of IoU 0.85", well},
                {"share", rounded(share, 3)}});
    return row;
}

json measure(const effort& much) {
    json rooms = json::array();
    std::vector<recovered_surface> all;
    const std::uint64_t first = 10'001, count = much.quick ? 2 : 15;
    for (std::uint64_t seed = first; seed < first + count; ++seed) {
        const image one = image_of(seed);
        all.insert(all.end(), one.surfaces.begin(), one.surfaces.end());
        json row = row_of({{"seed", seed}, {"points", one.points}}, one.surfaces);
        row.update({{"segments", one.segments}, {"time [s]", rounded(one.seconds, 2)}});
        rooms.push_back(row);
        std::printf("%s\n", row.dump().c_str());
        std::fflush(stdout);
    }
    const json total = json::array({row_of({{"rooms", count}}, all)});
    std::printf("%s\n", total.dump().c_str());
    return {{"total", total}, {"rooms", rooms}};
}

}  // namespace

int main(int argc, char** argv) { return run_program(argc, argv, measure); }
