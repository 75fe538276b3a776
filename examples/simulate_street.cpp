// SPDX-License-Identifier: BSL-1.0
// What does a spinning lidar on a driving car see of a street?
#include <algorithm>
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/simulation.hpp>

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Simulates a spinning lidar on a driving car.")) return 0;
    // [simulate_street]
    namespace sim = gnomon::simulation;

    const sim::scene street = sim::scenes::street({.seed = 1});
    const sim::spinning_lidar lidar = sim::scanners::velodyne_hdl_32e();
    const sim::driving drive{.mount = street.sensor,
                             .duration = lidar.revolution(),
                             .velocity = Eigen::Vector3d(15, 0, 0)};

    const sim::true_scan truth = sim::simulate(street, drive, lidar, {.sigma = 0.02, .seed = 1});

    const auto road = street.find_surface("road/body/plane");
    const auto on_road = std::count(truth.surfaces.begin(), truth.surfaces.end(), road);
    std::printf("%td of %zu points on the road, seen from %zu places\n", on_road, truth.scan.size(),
                truth.scan.viewpoints.positions().size());
    // [simulate_street]
    return on_road > 0 ? 0 : 1;
}
