// SPDX-License-Identifier: BSL-1.0
#include <array>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include "laws/shape_laws.hpp"
#include "simulation/furnished.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/detail/mesh_builder.hpp>
#include <gnomon/simulation/vehicle.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::vehicle;

TEST(vehicle, has_its_measures) {
    for (const vehicle& v : {vehicle{}, sim::van()}) {
        const double wheels = v.width + 0.2 * v.wheel_width;
        furnished::expect_extent(v, {-0.5 * v.length, -0.5 * wheels, 0.0},
                                 {0.5 * v.length, 0.5 * wheels, v.height});
        furnished::expect_scales(v);
        EXPECT_EQ(furnished::parts_of(v), (std::set<std::string>{"body", "cabin", "wheel 1",
                                                                 "wheel 2", "wheel 3", "wheel 4"}));
    }
}

/// Rays along the middle, at the height of each part.
TEST(vehicle, shows_its_faces) {
    const vehicle car;
    const sim::scene world = furnished::scene_of(car);
    const sim::bvh_caster caster(world);
    const auto seen = [&](const Eigen::Vector3d& from, const Eigen::Vector3d& towards) {
        const auto hit = caster({from, towards});
        return hit ? world.surface_name(hit->surface) : "nothing";
    };
    EXPECT_EQ(seen({9, 0, 0.5}, {-1, 0, 0}), "piece/body/front");
    EXPECT_EQ(seen({9, 0, 0.8}, {-1, 0, 0}), "piece/body/bonnet");
    EXPECT_EQ(seen({9, 0, 1.2}, {-1, 0, 0}), "piece/cabin/windscreen");
    EXPECT_EQ(seen({9, 0, 1.5}, {-1, 0, 0}), "nothing");
    EXPECT_EQ(seen({-9, 0, 0.5}, {1, 0, 0}), "piece/body/rear");
    EXPECT_EQ(seen({-9, 0, 1.2}, {1, 0, 0}), "piece/cabin/rear window");
    EXPECT_EQ(seen({0, 0, 9}, {0, 0, -1}), "piece/cabin/roof");
    EXPECT_EQ(seen({-2, 0, 9}, {0, 0, -1}), "piece/body/deck");
    EXPECT_EQ(seen({0, 9, 0.8}, {0, -1, 0}), "piece/body/left");
    EXPECT_EQ(seen({0, -9, 1.2}, {0, 1, 0}), "piece/cabin/right");
    EXPECT_EQ(seen({0, 0, 0.01}, {0, 0, 1}), "piece/body/bottom");
    EXPECT_EQ(seen({1.3, 9, 0.3}, {0, -1, 0}), "piece/wheel 4/top");
    EXPECT_EQ(seen({1.3, -9, 0.3}, {0, 1, 0}), "piece/wheel 3/top");
}

/// Body and cabin are closed: a ray from within leaves each of them once.
TEST(vehicle, is_of_closed_solids) {
    for (const vehicle& v : {vehicle{}, sim::van()}) {
        const sim::scene world = furnished::scene_of(v);
        gnomon::random_stream random(20'001);
        for (std::size_t part = 0; part < 2; ++part) {
            const auto& solid = world.shapes()[part];
            const Eigen::Vector3d inside = solid.extent.middle();
            for (int i = 0; i < 5000; ++i) {
                const sim::ray out{inside, laws::random_direction(random)};
                const auto hit = solid.first_hit(out);
                ASSERT_TRUE(hit);
                EXPECT_FALSE(solid.first_hit({out.point_at(hit->range + 1e-9), out.direction}));
            }
        }
    }
}

TEST(vehicle, is_of_solids_that_obey_the_laws_of_shapes) {
    const std::array<sim::detail::profile_corner, 4> profile{
        {{-1, 0, 0.5}, {1, 0, 0.5}, {0.6, 0.8, 0.3}, {-0.7, 0.8, 0.3}}};
    const auto solid =
        sim::detail::symmetric_solid(profile, std::array{"bottom", "front", "top", "rear"});
    EXPECT_EQ(solid.surface_names(),
              (std::vector<std::string>{"bottom", "front", "top", "rear", "left", "right"}));
    EXPECT_GT(laws::obeys_shape_laws(solid, 20'002), 1000u);
}

TEST(vehicle, rejects_invalid_dimensions) {
    for (const vehicle& bad :
         {vehicle{.length = -1}, vehicle{.length = clouds::nan}, vehicle{.width = 0},
          vehicle{.height = 0.5}, vehicle{.height = clouds::infinity}, vehicle{.clearance = -0.1},
          vehicle{.belt_height = 0.5}, vehicle{.nose_height = 0.1}, vehicle{.bonnet = 4.0},
          vehicle{.bonnet = clouds::nan}, vehicle{.boot = -0.1}, vehicle{.roof_inset = 1.0},
          vehicle{.wheel_diameter = 0}, vehicle{.wheel_width = 1}, vehicle{.wheel_base = 4.2},
          vehicle{.wheel_base = clouds::nan}}) {
        sim::scene world;
        EXPECT_THROW(add(world, "car", bad), std::invalid_argument);
        EXPECT_TRUE(world.objects().empty());
    }
}

}  // namespace
