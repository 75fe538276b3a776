// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/neighborhoods/knn.hpp>
#include <gnomon/neighborhoods/spatial_index.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/scanner.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/thesis_scenes.hpp>

namespace sim = gnomon::simulation;

namespace {

namespace scenes = sim::scenes;
using gnomon::degrees;

/// What a ray straight down from close under the ceiling meets: the surface's name and the height.
std::pair<std::string, double> seen_from_above(const sim::scene& world, double x, double y) {
    const auto hit = sim::bvh_caster(world)({{x, y, 2.49}, {0, 0, -1}});
    if (!hit) return {"nothing", 0.0};
    return {world.surface_name(hit->surface), 2.49 - hit->range};
}

void expect_seen(const sim::scene& world, double x, double y, const std::string& surface,
                 double height) {
    const auto [name, z] = seen_from_above(world, x, y);
    EXPECT_EQ(name, surface);
    EXPECT_NEAR(z, height, 1e-12) << surface;
}

/// The points of each object.
std::map<std::string, std::size_t> points_of_objects(const sim::scene& world,
                                                     const sim::true_scan& truth) {
    std::map<std::string, std::size_t> count;
    for (const auto object : truth.objects)
        ++count[world.objects()[static_cast<std::size_t>(object)]];
    return count;
}

TEST(thesis_scenes, box_and_cylinder_stand_where_they_should) {
    const auto world = scenes::box_and_cylinder();
    expect_seen(world, 2.2, -0.55, "box/body/+z", 0.6);
    expect_seen(world, 2.4, 0.55, "cylinder/body/top", 0.9);
    EXPECT_EQ(seen_from_above(world, 1.0, 0.0).first, "nothing");
}

TEST(thesis_scenes, boxes_and_bin_return_as_many_points_as_the_figure) {
    const auto world = scenes::boxes_and_bin();
    const auto truth = sim::simulate(
        world, sim::horizontal{.mount = world.sensor, .duration = 0.455, .sweep = degrees(70)},
        sim::scanners::sick_lms_400());
    EXPECT_NEAR(static_cast<double>(truth.scan.size()), 7346.0, 0.05 * 7346.0);
    EXPECT_EQ(points_of_objects(world, truth).size(), 3u);
}

TEST(thesis_scenes, plates_lie_anywhere_and_show_their_face) {
    std::array<int, 2> sides{};
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const auto world = scenes::plate(seed);
        const sim::pose& place = world.shapes().front().pose;
        EXPECT_LE(std::abs(place.position.x() - 1.5), 1.0);
        EXPECT_LE(std::abs(place.position.y()), 1.0);
        EXPECT_LE(std::abs(place.position.z()), 0.5);
        const auto hit = sim::bvh_caster(world)({{0, 0, 0}, place.position.normalized()});
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->range, place.position.norm(), 1e-9);
        ++sides[place.rotation(0, 2) > 0.0];
    }
    EXPECT_GT(sides[0], 50);
    EXPECT_GT(sides[1], 50);
    EXPECT_EQ(scenes::plate(5).shapes().front().pose.position,
              scenes::plate(5).shapes().front().pose.position);
}

TEST(thesis_scenes, kitchen_is_furnished_by_the_numbers) {
    const auto world = scenes::kitchen();
    expect_seen(world, 2.2, -0.2, "table/top/+z", 0.74);
    expect_seen(world, 2.59, 0.39, "table/top/+z", 0.74);
    expect_seen(world, 2.61, 0.30, "room/floor/plane", 0.0);
    expect_seen(world, 3.61, 1.31, "cupboard/body/+z", 2.1);
    expect_seen(world, 3.59, 1.31, "room/floor/plane", 0.0);
    expect_seen(world, 3.9, -1.59, "sink cabinet/body/+z", 0.9);
    expect_seen(world, 1.55, -0.50, "chair 1/seat/+z", 0.45);
    expect_seen(world, 1.35, -0.50, "chair 1/back/+z", 0.90);  // faces +x
    expect_seen(world, 1.35, 0.25, "chair 2/back/+z", 0.90);
    expect_seen(world, 3.05, -0.50, "chair 3/back/+z", 0.90);  // faces -x
    expect_seen(world, 2.20, 0.95, "chair 4/back/+z", 0.90);   // faces -y
    // The lattice: five slats 0.03 wide, so gaps of 0.0675, between rails 0.04 high.
    const sim::bvh_caster caster(world);
    const auto through = [&](double y, double z) {
        const auto hit = caster({{1.0, y, z}, {1, 0, 0}, 0.40});
        return hit ? world.surface_name(hit->surface) : "nothing";
    };
    EXPECT_EQ(through(0.25, 0.70), "chair 2/back/-x");
    EXPECT_EQ(through(0.25 + 0.05, 0.70), "nothing");
    EXPECT_EQ(through(0.25 + 0.05, 0.48), "chair 2/back/-x");
    EXPECT_EQ(through(0.25 + 0.05, 0.88), "chair 2/back/-x");
    EXPECT_EQ(through(0.25 + 0.0975, 0.70), "chair 2/back/-x");
}

TEST(thesis_scenes, kitchen_scales_its_furniture_on_the_floor) {
    for (const double scale : {0.85, 1.15}) {
        const auto world = scenes::kitchen(scale);
        expect_seen(world, 2.2, -0.2, "table/top/+z", 0.74 * scale);
        expect_seen(world, 1.55, -0.50, "chair 1/seat/+z", 0.45 * scale);
        expect_seen(world, 4.0, 1.7, "cupboard/body/+z", 2.1 * scale);
    }
}

TEST(thesis_scenes, living_room_is_furnished_by_the_numbers) {
    const auto world = scenes::living_room();
    expect_seen(world, 1.74, 0.0, "room/floor/plane", 0.0);
    expect_seen(world, 1.76, 0.0, "step 1/body/+z", 0.15);
    expect_seen(world, 2.01, 0.0, "step 2/body/+z", 0.30);
    expect_seen(world, 2.26, 0.0, "platform/body/+z", 0.45);
    expect_seen(world, 3.1, 1.1, "armchair 1/seat/+z", 0.87);
    expect_seen(world, 3.1, 1.42, "armchair 1/back/+z", 1.30);  // faces -y
    expect_seen(world, 2.75, 1.0, "armchair 1/arm right/+z", 1.05);
    expect_seen(world, 3.1, -1.42, "armchair 2/back/+z", 1.30);  // faces +y
    expect_seen(world, 3.3, 0.0, "small table/top/+z", 0.90);
    expect_seen(world, 4.7, 0.0, "sideboard/body/+z", 1.25);
    EXPECT_EQ(seen_from_above(world, 2.9, 2.09).first, "vase/body/mantle");
}

/// Each named object is seen by each of the trajectories.
TEST(thesis_scenes, every_object_is_seen) {
    for (const auto& [name, world] : {std::pair{"kitchen", scenes::kitchen()},
                                      {"living room", scenes::living_room()},
                                      {"two chairs", scenes::two_chairs()},
                                      {"SAT", scenes::seat_armchair_table()}}) {
        SCOPED_TRACE(name);
        for (const auto& truth : {sim::simulate(world, sim::horizontal{.mount = world.sensor}),
                                  sim::simulate(world, sim::vertical{.mount = world.sensor}),
                                  sim::simulate(world, sim::rotational{.mount = world.sensor})}) {
            const auto count = points_of_objects(world, truth);
            EXPECT_EQ(count.size(), world.objects().size());
            for (const auto& [object, points] : count) EXPECT_GT(points, 150u) << object;
        }
    }
}

/// Sec. 2.4.3: of the three trajectories the rotational one is the least homogeneous: the largest
/// distance to the tenth neighbor is many times the smallest, on the objects in view. (On
/// floor, ceiling and walls next to the sensor the others are no better: their scan lines cross
/// there.)
TEST(thesis_scenes, rotational_scans_of_objects_are_the_least_homogeneous) {
    for (const auto& world : {scenes::kitchen(), scenes::living_room(), scenes::two_chairs()}) {
        const auto spread = [&](const auto& trajectory) {
            const auto truth = sim::simulate(world, trajectory, sim::densities::medium());
            std::vector<Eigen::Vector3d> points;
            for (std::size_t i = 0; i < truth.scan.size(); ++i) {
                if (truth.objects[i] != 0) points.push_back(truth.scan.points[i]);  // not the room
            }
            const gnomon::spatial_index index(points);
            std::vector<gnomon::neighbor> found;
            double least = 1e9;
            double most = 0.0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                gnomon::knn{.k = 10}.find(index, i, found);
                least = std::min(least, found.back().squared_distance);
                most = std::max(most, found.back().squared_distance);
            }
            return std::sqrt(most / least);
        };
        const double rotational = spread(sim::rotational{.mount = world.sensor});
        EXPECT_GT(rotational, 3 * spread(sim::horizontal{.mount = world.sensor}));
        EXPECT_GT(rotational, 3 * spread(sim::vertical{.mount = world.sensor}));
    }
}

/// The angular density of a rotational scan falls as 1 / sin of the angle to the viewing direction,
/// so that annuli of equal width hold equal numbers of points.
TEST(thesis_scenes, rotational_annuli_hold_equal_numbers) {
    const auto world = scenes::kitchen();
    const auto truth = sim::simulate(world, sim::rotational{.mount = world.sensor});
    const Eigen::Vector3d axis = world.sensor.direction_out({1, 0, 0});
    std::array<int, 9> neighborhoods{};
    for (const auto& u : truth.directions) {
        const double angle = std::acos(std::clamp(u.dot(axis), -1.0, 1.0));
        ++neighborhoods[static_cast<std::size_t>(angle / degrees(10.0001).radians())];
    }
    for (const int count : neighborhoods) EXPECT_EQ(count, 12'800);
}

}  // namespace
