// SPDX-License-Identifier: BSL-1.0
// How do I scan with a ray caster and a trajectory of my own?
#include <cstddef>
#include <cstdio>
#include <optional>

#include "common/help.hpp"
#include <gnomon/simulation.hpp>

// [own_ray_caster]
namespace sim = gnomon::simulation;

/// Asks all shapes of a scene one after the other.
struct linear_caster {
    const sim::scene* world;

    std::optional<sim::ray_hit> operator()(sim::ray r) const {
        std::optional<sim::ray_hit> nearest;
        for (const auto& shape : world->shapes()) {
            if (const auto hit = shape.first_hit(r)) {
                r.reach = hit->range;
                nearest = hit;
            }
        }
        return nearest;
    }
};
static_assert(sim::ray_caster<linear_caster>);
// [own_ray_caster]

// [own_trajectory]
/// Drives forward without turning.
struct forward {
    sim::pose mount;
    double duration = 4.0;  // [s]
    double speed = 0.1;     // [m/s]

    sim::pose operator()(double seconds) const { return mount * sim::at(speed * seconds, 0, 0); }
};
static_assert(sim::sensor_trajectory<forward>);
// [own_trajectory]

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Simulates a scan with a ray caster and a trajectory of its own."))
        return 0;
    const sim::scene kitchen = sim::scenes::kitchen();
    const auto truth =
        sim::simulate(kitchen, linear_caster{&kitchen}, forward{.mount = kitchen.sensor});
    std::printf("%zu points\n", truth.scan.size());
    return truth.scan.size() > 0 ? 0 : 1;
}
