// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>

#include <Eigen/Core>
#include <gtest/gtest.h>

#include "simulation/furnished.hpp"
#include <gnomon/simulation/object_views.hpp>
#include <gnomon/simulation/office_tables.hpp>

namespace sim = gnomon::simulation;

namespace {

/// More tables do not change those that are there, and other seeds give others.
TEST(office_tables, depend_on_seed_and_number_only) {
    const auto few = sim::office_tables(4, 3), many = sim::office_tables(9, 3),
               others = sim::office_tables(4, 4);
    ASSERT_EQ(few.size(), 4u);
    EXPECT_TRUE(sim::office_tables(0, 3).empty());
    for (std::size_t i = 0; i < few.size(); ++i) {
        EXPECT_EQ(few[i].name, "office table");
        const auto extent = furnished::scene_of(few[i]).extent();
        const auto same = furnished::scene_of(many[i]);
        EXPECT_EQ(furnished::parts_of(few[i]), furnished::parts_of(many[i]));
        EXPECT_EQ(extent.high, same.extent().high);
        EXPECT_NE(extent.high, furnished::scene_of(others[i]).extent().high);
    }
}

/// They stand on the floor, desks are as large as such and carry up to five things, side tables are
/// lower, carry up to two, and some have a shelf. Nothing is wider than the top.
TEST(office_tables, have_the_measures_of_the_real) {
    std::set<std::string> parts;
    const auto all = sim::office_tables(200, 7);
    std::array<std::size_t, 6> with_things{};  // tables with this number of things on them
    for (std::size_t i = 0; i < all.size(); ++i) {
        const bool is_desk = i % 2 == 0;
        const sim::scene world = furnished::scene_of(all[i]);
        const sim::bounds extent = world.extent();
        const Eigen::Vector3d size = extent.size();
        EXPECT_NEAR(extent.low.z(), 0.0, 1e-9);
        EXPECT_GE(size.x(), is_desk ? 1.2 : 0.5);
        EXPECT_LE(size.x(), is_desk ? 2.6 : 1.2);
        EXPECT_LE(size.y(), size.x() + 1e-9);
        EXPECT_NEAR(extent.high.x(), -extent.low.x(), 1e-9);
        EXPECT_NEAR(extent.high.y(), -extent.low.y(), 1e-9);
        EXPECT_GE(size.z(), is_desk ? 0.68 : 0.38);
        EXPECT_LE(size.z(), (is_desk ? 0.78 : 0.62) + 0.40 + 1e-9);
        ASSERT_EQ(world.objects().size(), 1u);
        const auto of_this = furnished::parts_of(all[i]);
        const auto things = std::ranges::count_if(
            of_this, [](const std::string& name) { return name.starts_with("thing"); });
        ASSERT_LE(things, is_desk ? 5 : 2);
        ++with_things[static_cast<std::size_t>(things)];
        EXPECT_FALSE(is_desk && of_this.contains("shelf"));
        parts.insert(of_this.begin(), of_this.end());
    }
    EXPECT_EQ(parts, (std::set<std::string>{"leg 1", "leg 2", "leg 3", "leg 4", "panel 1",
                                            "panel 2", "shelf", "thing 1", "thing 2", "thing 3",
                                            "thing 4", "thing 5", "top"}));
    for (const std::size_t count : with_things) EXPECT_GT(count, 0u);
}

/// Views have enough points to be learned.
TEST(office_tables, are_seen) {
    for (const auto& model : sim::office_tables(3, 1))
        EXPECT_GT(sim::simulate_object_view(model, 0).points_of_model().size(), 60u);
}

}  // namespace
