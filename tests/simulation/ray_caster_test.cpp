// SPDX-License-Identifier: BSL-1.0
#include <optional>

#include <gtest/gtest.h>

#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/ray_caster.hpp>
#include <gnomon/simulation/scene.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>
#include <gnomon/simulation/trajectory.hpp>

namespace {

static_assert(gnomon::ray_caster<gnomon::bvh_caster>);
static_assert(!gnomon::ray_caster<gnomon::scene>);
static_assert(!gnomon::ray_caster<double>);

/// A caster of somebody else's, who has a plane only.
TEST(ray_caster, may_be_a_lambda) {
    const auto floor_only = [](const gnomon::ray& r) -> std::optional<gnomon::ray_hit> {
        const double range = -r.origin.z() / r.direction.z();
        if (!(range > 0.0 && range <= r.reach)) return std::nullopt;
        return gnomon::ray_hit{range, {0, 0, 1}, 0};
    };
    const auto world = gnomon::scenes::kitchen();
    const auto truth = gnomon::simulate(
        world, floor_only,
        gnomon::fixed{.mount = gnomon::at(0, 0, 1) * gnomon::pitch(gnomon::degrees(30))});
    EXPECT_GT(truth.scan.size(), 1000u);
    for (const auto& p : truth.scan.points) EXPECT_NEAR(p.z(), 0.0, 1e-12);
}

}  // namespace
