// SPDX-License-Identifier: BSL-1.0
// How does one scan a shape that the library does not have?
#include <array>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string_view>

#include "common/help.hpp"
#include <gnomon/simulation.hpp>

// [own_shape]
namespace sim = gnomon::simulation;

/// A disc in the plane z = 0, seen from both sides.
struct disc {
    double radius;  ///< [m]

    sim::bounds extent() const { return {{-radius, -radius, 0.0}, {radius, radius, 0.0}}; }

    static std::array<std::string_view, 1> surface_names() { return {"disc"}; }

    std::optional<sim::ray_hit> first_hit(const sim::ray& r) const {
        const double range = -r.origin.z() / r.direction.z();
        if (!(range > 0.0 && range <= r.reach)) return std::nullopt;
        if (r.point_at(range).norm() > radius) return std::nullopt;
        return sim::ray_hit{range, {0.0, 0.0, r.direction.z() > 0.0 ? -1.0 : 1.0}, 0};
    }
};
static_assert(sim::shape<disc>);
// [own_shape]

int main(int argc, char** argv) {
    if (printed_help(argc, argv, "Simulates a scan of a shape of its own.")) return 0;
    sim::scene world = sim::scenes::kitchen();
    world.add_object("mirror", disc{0.4},
                     sim::at(1.2, -2.19, 1.5) * sim::roll(gnomon::degrees(90)));
    const auto truth = sim::simulate(world, sim::horizontal{.mount = world.sensor});
    std::size_t points = 0;
    for (const auto object : truth.objects)
        points += world.objects()[static_cast<std::size_t>(object)] == "mirror";
    std::printf("%zu points on the mirror\n", points);
    return points > 0 ? 0 : 1;
}
