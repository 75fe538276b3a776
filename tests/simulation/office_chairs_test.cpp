// SPDX-License-Identifier: BSL-1.0
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "simulation/furnished.hpp"
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/office_chairs.hpp>

namespace sim = gnomon::simulation;

namespace {

using furnished::scene_of;

/// More chairs do not change those that are there, and other seeds give others.
TEST(office_chairs, depend_on_seed_and_number_only) {
    const auto few = sim::office_chairs(4, 3), many = sim::office_chairs(9, 3),
               others = sim::office_chairs(4, 4);
    ASSERT_EQ(few.size(), 4u);
    EXPECT_TRUE(sim::office_chairs(0, 3).empty());
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].name, "office chair");
        const auto extent = scene_of(few[i]).extent();
        EXPECT_EQ(extent.high, scene_of(many[i]).extent().high);
        EXPECT_NE(extent.high, scene_of(others[i]).extent().high);
    }
}

/// They stand on the floor, are as large as office chairs, and have the parts of such.
TEST(office_chairs, have_the_measures_of_the_real) {
    std::set<std::string> parts;
    for (const auto& model : sim::office_chairs(60, 7)) {
        const sim::scene world = scene_of(model);
        const sim::bounds extent = world.extent();
        EXPECT_GE(extent.low.z(), 0.0);
        EXPECT_LE(extent.low.z(), 0.05 + 1e-9) << "feet";
        EXPECT_GE(extent.high.z(), 0.42 + 0.45);
        EXPECT_LE(extent.high.z(), 0.52 + 0.15 + 0.70 + 0.20 + 0.01);
        for (int a = 0; a < 2; ++a) {
            EXPECT_LE(extent.high[a], 0.4);
            EXPECT_GE(extent.low[a], -0.75);
        }
        ASSERT_EQ(world.objects().size(), 1u);
        parts.merge(furnished::parts_of(model));
    }
    EXPECT_EQ(parts, (std::set<std::string>{"arm", "back", "bar", "column", "foot", "headrest",
                                            "post", "seat"}));
}

/// A view of a chair shows it from the side from which it is seen.
TEST(office_chairs, are_seen) {
    for (const auto& model : sim::office_chairs(3, 1))
        EXPECT_GT(sim::simulate_object_view(model, 0).points_of_model().size(), 60u);
}

}  // namespace
