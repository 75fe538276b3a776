// SPDX-License-Identifier: BSL-1.0
// A type that each concept of the simulator refuses; docs/concepts quotes the messages.
#include <array>
#include <optional>
#include <string_view>

#include <gnomon/simulation/ray.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/shape.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace sim = gnomon::simulation;

// expect: s\.extent\(\)
// [refused_shape]
struct unbounded {
    static std::array<std::string_view, 1> surface_names() { return {"plane"}; }
    std::optional<sim::ray_hit> first_hit(const sim::ray& r) const;
};
static_assert(sim::shape<unbounded>);  // no extent()
// [refused_shape]

// expect: caster\(r\)
// [refused_ray_caster]
struct range_only {
    double operator()(const sim::ray& r) const;
};
static_assert(sim::ray_caster<range_only>);  // gives a range, no ray_hit
// [refused_ray_caster]

// expect: trajectory\.duration
// [refused_trajectory]
struct endless {
    sim::pose operator()(double seconds) const;
};
static_assert(sim::sensor_trajectory<endless>);  // no duration
// [refused_trajectory]

int main() {}
