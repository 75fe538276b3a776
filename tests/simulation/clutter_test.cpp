// SPDX-License-Identifier: BSL-1.0
#include <cstddef>
#include <map>
#include <string>

#include <gtest/gtest.h>

#include "simulation/furnished.hpp"
#include <gnomon/simulation/clutter.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

using furnished::scene_of;

/// More pieces do not change those that are there, and other seeds give others.
TEST(clutter, depends_on_seed_and_number_only) {
    const auto few = sim::clutter_models(8, 3), many = sim::clutter_models(24, 3),
               others = sim::clutter_models(8, 4);
    ASSERT_EQ(few.size(), 8u);
    EXPECT_TRUE(sim::clutter_models(0, 3).empty());
    std::map<std::string, int> kinds;
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].name, many[i].name);
        EXPECT_EQ(few[i].name, others[i].name);
        const auto extent = scene_of(few[i]).extent();
        EXPECT_EQ(extent.low, scene_of(many[i]).extent().low);
        EXPECT_EQ(extent.high, scene_of(many[i]).extent().high);
        EXPECT_NE(extent.high, scene_of(others[i]).extent().high);
        ++kinds[few[i].name];
    }
    EXPECT_EQ(kinds.size(), 6u);
}

/// Pieces stand on the floor, 0.3 to 1.8 m high, not wider than furniture, and are seen.
TEST(clutter, has_the_measures_of_the_real) {
    double highest = 0.0;
    for (const auto& model : sim::clutter_models(160, 7)) {
        SCOPED_TRACE(model.name);
        const sim::scene world = scene_of(model);
        const sim::bounds extent = world.extent();
        EXPECT_NEAR(extent.low.z(), 0.0, model.name == "curtain" ? 0.15 + 1e-9 : 1e-9);
        EXPECT_GE(extent.high.z(), 0.3 - 1e-9);
        EXPECT_LE(extent.high.z(), 1.8 + 1e-9);
        highest = std::max(highest, extent.high.z());
        for (int a = 0; a < 2; ++a) {
            EXPECT_LE(extent.high[a], 0.66);
            EXPECT_GE(extent.low[a], -0.66);
        }
        const auto truth = sim::simulate(
            world, sim::vertical{.mount = sim::yaw(gnomon::degrees(180)) * sim::at(-3, 0, 1.2)});
        EXPECT_GT(truth.scan.size(), 60u);
    }
    EXPECT_GT(highest, 1.7);
}

}  // namespace
