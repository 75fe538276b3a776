// SPDX-License-Identifier: BSL-1.0
#include <optional>

#include <gtest/gtest.h>

#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::ray_caster<sim::bvh_caster>);
static_assert(!sim::ray_caster<sim::scene>);
static_assert(!sim::ray_caster<double>);

/// A user-defined caster of a single plane.
TEST(ray_caster, can_be_a_lambda) {
    const auto floor_only = [](const sim::ray& r) -> std::optional<sim::ray_hit> {
        const double range = -r.origin.z() / r.direction.z();
        if (!(range > 0.0 && range <= r.reach)) return std::nullopt;
        return sim::ray_hit{range, {0, 0, 1}, 0};
    };
    const auto world = sim::scenes::kitchen();
    const auto truth = sim::simulate(
        world, floor_only, sim::fixed{.mount = sim::at(0, 0, 1) * sim::pitch(gnomon::degrees(30))});
    EXPECT_GT(truth.scan.size(), 1000u);
    for (const auto& p : truth.scan.points) EXPECT_NEAR(p.z(), 0.0, 1e-12);
}

}  // namespace
