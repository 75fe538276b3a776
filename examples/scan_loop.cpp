// SPDX-License-Identifier: BSL-1.0
// How do I process one scan after the other, as a robot does? The result and the threads are kept,
// so that from the second scan on hardly any memory is allocated.
#include <cstddef>
#include <cstdint>
#include <cstdio>

#include "common/help.hpp"
#include <gnomon/gnomon.hpp>
#include <gnomon/perception.hpp>
#include <gnomon/simulation.hpp>

namespace sim = gnomon::simulation;

namespace {

/// The scan of a sensor that has moved by a step of 2 cm for each frame.
gnomon::scan next_scan(const sim::scene& room, int frame) {
    sim::pose mount = room.sensor;
    mount.position.x() += 0.02 * frame;
    return sim::simulate(room, sim::rotational{.mount = mount}, sim::densities::low(),
                         {.sigma = 0.015, .seed = static_cast<std::uint64_t>(frame)})
        .scan;
}

}  // namespace

int main(int argc, char** argv) {
    if (printed_help(argc, argv,
                     "Processes simulated scans, one after the other, on threads that stay alive."))
        return 0;
    const sim::scene room = sim::scenes::kitchen();
    // [scan_loop]
    const gnomon::perception chain{gnomon::knn{.k = 30}, gnomon::plane_pca{},
                                   gnomon::conservative{}};
    gnomon::stop_source stop;  // another thread may call stop.request_stop()
    const gnomon::supervised run(gnomon::team(2), stop.token(),
                                 [](const char* step, std::size_t number, std::size_t steps) {
                                     std::printf("%zu/%zu %s\n", number, steps, step);
                                 });

    gnomon::perception_result<> seen;  // keeps its memory from scan to scan
    try {
        for (int frame = 0; frame < 3; ++frame) {
            const gnomon::scan scan = next_scan(room, frame);
            chain.into(seen, scan, run);
            std::printf("frame %d: %zu surfaces in %zu points\n", frame, seen.surfaces.size(),
                        scan.size());
        }
    } catch (const gnomon::stopped&) {
        std::printf("stopped\n");
    }
    // [scan_loop]
}
