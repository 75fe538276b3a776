// SPDX-License-Identifier: BSL-1.0
#include <map>
#include <set>
#include <string>
#include <variant>

#include <gtest/gtest.h>

#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace sim = gnomon::simulation;

namespace {

TEST(furniture, has_six_chairs_and_six_tables_of_different_names) {
    std::set<std::string> names;
    int chairs = 0;
    for (const auto& model : sim::furniture_models()) {
        names.insert(model.name);
        chairs += std::holds_alternative<sim::chair>(model.piece);
    }
    EXPECT_EQ(names.size(), 12u);
    EXPECT_EQ(chairs, 6);
}

/// Real chairs have seats 0.43 to 0.47 m high, real tables are 0.45 to 0.75 m high.
TEST(furniture, has_the_measures_of_the_real) {
    for (const auto& model : sim::furniture_models()) {
        sim::scene world;
        sim::add(world, model);
        const auto hit = sim::bvh_caster(world)({{0, 0, 3}, {0, 0, -1}});
        ASSERT_TRUE(hit) << model.name;
        const double height = 3.0 - hit->range;
        const bool is_chair = std::holds_alternative<sim::chair>(model.piece);
        EXPECT_NE(world.surface_name(hit->surface).find(is_chair ? "/seat/" : "/top/"),
                  std::string::npos)
            << model.name;
        EXPECT_GE(height, (is_chair ? 0.43 : 0.45) - 1e-9) << model.name;
        EXPECT_LE(height, (is_chair ? 0.47 : 0.75) + 1e-9) << model.name;
    }
}

/// Pieces stand on the floor, and each of their parts is seen from somewhere.
TEST(furniture, stands_on_the_floor_and_shows_its_parts) {
    for (const auto& model : sim::furniture_models()) {
        SCOPED_TRACE(model.name);
        sim::scene world;
        sim::add(world, model);
        double lowest = 1.0;
        for (const auto& s : world.shapes()) lowest = std::min(lowest, s.extent.low.z());
        EXPECT_NEAR(lowest, 0.0, 1e-9);

        std::set<std::int32_t> seen;
        for (int side = 0; side < 8; ++side) {
            const sim::pose mount = sim::yaw(gnomon::degrees(45.0 * side)) * sim::at(-2.5, 0, 1.2) *
                                    sim::pitch(gnomon::degrees(20));
            const auto truth = sim::simulate(world, sim::vertical{.mount = mount});
            seen.insert(truth.parts.begin(), truth.parts.end());
        }
        EXPECT_EQ(seen.size(), world.parts().size());
    }
}

/// A scene becomes one object of the model's name, of however many objects it consists.
TEST(furniture, may_be_any_scene) {
    sim::scene lamp;
    lamp.add_object("foot", sim::box{0.2, 0.2, 0.1}, sim::at(0, 0, 0.05));
    lamp.add_object("shade", sim::box{0.3, 0.3, 0.3}, sim::at(0, 0, 1.5));
    const sim::furniture_model model{"lamp", lamp};
    sim::scene world;
    sim::add(world, sim::furniture_models().front());
    EXPECT_EQ(sim::add(world, model, sim::at(2, 0, 0)), 1);
    EXPECT_EQ(world.objects().back(), "lamp");
    EXPECT_EQ(world.parts().back().object, 1);
    const auto hit = sim::bvh_caster(world)({{2, 0, 3}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->range, 1.35, 1e-12);
}

}  // namespace
