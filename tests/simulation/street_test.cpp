// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/execution.hpp>
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/simulate.hpp>
#include <gnomon/simulation/spinning_lidar.hpp>
#include <gnomon/simulation/street.hpp>

namespace sim = gnomon::simulation;

namespace {

using sim::scenes::street;

constexpr std::uint64_t some_seeds[] = {20'001, 20'002, 20'003, 20'004, 20'005, 20'006};

/// The name of an object without its number: "car 2" is a car.
std::string kind_of(const std::string& name) {
    const auto end = name.find_last_not_of("0123456789 ");
    return name.substr(0, end + 1);
}

/// A sweep of 64 beams from the sensor of the street.
sim::true_scan sweep_of(const sim::scene& world, const sim::beam& b = {}) {
    const auto lidar = sim::scanners::velodyne_hdl_64e();
    return sim::simulate(world, sim::fixed{.mount = world.sensor, .duration = lidar.revolution()},
                         lidar, b);
}

/// The number of points on each kind of object.
std::map<std::string, std::size_t> points_of_kinds(const sim::scene& world,
                                                   const sim::true_scan& truth) {
    std::map<std::string, std::size_t> count;
    for (const std::int32_t object : truth.objects)
        ++count[kind_of(world.objects()[static_cast<std::size_t>(object)])];
    return count;
}

/// The bounds of each object.
std::map<std::string, sim::bounds> extents_of(const sim::scene& world) {
    std::map<std::string, sim::bounds> extents;
    for (const sim::placed_shape& s : world.shapes()) {
        const auto part = world.surfaces()[static_cast<std::size_t>(s.first_surface)].part;
        const auto object = world.parts()[static_cast<std::size_t>(part)].object;
        extents[world.objects()[static_cast<std::size_t>(object)]].extend(s.extent);
    }
    return extents;
}

/// "door" or "window 5", not "window 5 sill".
bool is_pane(const std::string& name) {
    return name == "door" || (kind_of(name) == "window" && name != "window");
}

bool is_vehicle(const std::string& name) {
    const std::string kind = kind_of(name);
    return kind == "car" || kind == "van" || kind == "own car";
}

TEST(street, differs_from_seed_to_seed_only) {
    const auto scan = [](std::uint64_t seed, const auto& run) {
        const auto world = street({.seed = seed});
        const auto lidar = sim::scanners::velodyne_vlp_16();
        return sim::simulate(world, sim::driving{.mount = world.sensor}, lidar,
                             {.sigma = 0.02, .seed = seed}, run);
    };
    const auto a = scan(20'001, gnomon::sequential{});
    const auto b = scan(20'001, gnomon::threads{3});
    ASSERT_EQ(a.scan.size(), b.scan.size());
    EXPECT_EQ(std::memcmp(a.scan.points.data(), b.scan.points.data(),
                          a.scan.size() * sizeof(a.scan.points[0])),
              0);
    EXPECT_EQ(a.surfaces, b.surfaces);
    EXPECT_NE(a.surfaces, scan(20'002, gnomon::sequential{}).surfaces);
    EXPECT_EQ(street({.seed = 7}).objects(), street({.seed = 7}).objects());
}

TEST(street, has_all_kinds_of_objects_in_a_sweep) {
    std::map<std::string, std::size_t> all;
    for (const auto seed : some_seeds) {
        const auto world = street({.seed = seed});
        const auto truth = sweep_of(world);
        EXPECT_GT(truth.scan.size(), 120'000u);
        for (const auto& [kind, points] : points_of_kinds(world, truth)) all[kind] += points;
        const auto count = points_of_kinds(world, truth);
        for (const char* kind : {"road", "pavement left", "pavement right", "house"})
            EXPECT_GT(count.at(kind), 800u) << kind << seed;
        for (const char* kind : {"kerb left", "kerb right"})
            EXPECT_GT(count.at(kind), 20u) << kind << seed;
    }
    for (const char* kind : {"car", "van", "tree", "hedge", "pole"})
        EXPECT_GT(all[kind], 1000u) << kind;
    EXPECT_EQ(all.size(), 11u);
}

/// The names that the documentation promises; objects of the same kind differ in their numbers.
TEST(street, has_stable_names) {
    for (const auto seed : some_seeds) {
        const auto world = street({.own_car = true, .seed = seed});
        for (const char* name :
             {"road/body/plane", "pavement left/body/plane", "pavement right/body/plane",
              "kerb left/body/plane", "kerb right/body/plane", "house 3/facade/wall",
              "house 3/facade/window 5", "house 3/facade/door", "house 3/shell/left",
              "house 3/shell/roof front", "car 2/body/left", "van 1/cabin/windscreen",
              "own car/cabin/roof", "tree 1/trunk/mantle", "tree 1/crown/leaves",
              "hedge 1/body/leaves", "pole 1/post/mantle"}) {
            EXPECT_NE(world.find_surface(name), sim::nothing) << name;
        }
        const std::set<std::string> objects(world.objects().begin(), world.objects().end());
        EXPECT_EQ(objects.size(), world.objects().size());
    }
}

/// The points of the large surfaces lie in the planes that the options name, kerbs between them.
TEST(street, is_level) {
    for (const double kerb : {0.06, 0.12}) {
        const auto world = street({.kerb = kerb, .seed = 20'003});
        const auto truth = sweep_of(world);
        std::set<double> kerbs;
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            const std::string& name = world.objects()[static_cast<std::size_t>(truth.objects[i])];
            const Eigen::Vector3d p = truth.scan.points[i];
            if (name == "road") {
                EXPECT_NEAR(p.z(), 0.0, 1e-12);
            } else if (name.starts_with("pavement")) {
                EXPECT_NEAR(p.z(), kerb, 1e-12);
            } else if (name.starts_with("kerb")) {
                EXPECT_GE(p.z(), -1e-6);
                EXPECT_LE(p.z(), kerb + 1e-6);
                kerbs.insert(std::round(1e9 * p.y()));
            }
        }
        EXPECT_EQ(kerbs.size(), 2u);
    }
    // The height of the kerb changes nothing else.
    EXPECT_EQ(street({.kerb = 0.06, .seed = 20'003}).objects(),
              street({.kerb = 0.20, .seed = 20'003}).objects());
}

/// The wall of a facade is a plane; windows and doors lie 10 to 20 cm behind it.
TEST(street, has_recesses_in_flat_walls) {
    std::size_t panes = 0;
    for (const auto seed : some_seeds) {
        const auto world = street({.seed = seed});
        const auto truth = sweep_of(world);
        std::map<std::int32_t, double> wall_of;
        for (const bool of_walls : {true, false}) {
            for (std::size_t i = 0; i < truth.scan.size(); ++i) {
                const auto& surface = world.surfaces()[static_cast<std::size_t>(truth.surfaces[i])];
                if (world.parts()[static_cast<std::size_t>(surface.part)].name != "facade")
                    continue;
                const double y = truth.scan.points[i].y();
                if (of_walls && surface.name == "wall") {
                    EXPECT_NEAR(wall_of.emplace(surface.part, y).first->second, y, 1e-9);
                } else if (!of_walls && wall_of.contains(surface.part) && is_pane(surface.name)) {
                    const double depth = std::abs(y) - std::abs(wall_of[surface.part]);
                    EXPECT_GE(depth, 0.10 - 1e-9);
                    EXPECT_LE(depth, 0.20 + 1e-9);
                    ++panes;
                }
            }
        }
    }
    EXPECT_GT(panes, 5000u);
}

/// The same objects at the same places, but without openings, wheels and slanted faces.
TEST(street, can_be_plain) {
    for (const auto seed : some_seeds) {
        const auto detailed = street({.seed = seed}), plain = street({.plain = true, .seed = seed});
        EXPECT_EQ(plain.objects(), detailed.objects());
        EXPECT_EQ(plain.sensor.position, detailed.sensor.position);
        for (const auto& surface : plain.surfaces()) {
            const std::string& part = plain.parts()[static_cast<std::size_t>(surface.part)].name;
            EXPECT_FALSE(part == "cabin" || part.starts_with("wheel")) << part;
            EXPECT_FALSE(surface.name.starts_with("window") || surface.name.starts_with("door"));
        }
        EXPECT_NE(plain.find_surface("house 3/facade/wall"), sim::nothing);
        EXPECT_NE(plain.find_surface("car 2/body/+x"), sim::nothing);
    }
}

/// A parabola from kerb to kerb, on which the vehicles stand.
TEST(street, can_have_a_curved_road) {
    constexpr double crown = 0.1;
    for (const auto seed : some_seeds) {
        const auto flat = street({.seed = seed}), curved = street({.crown = crown, .seed = seed});
        EXPECT_EQ(curved.objects(), flat.objects());
        const double lifted = curved.sensor.position.z() - flat.sensor.position.z();
        EXPECT_GT(lifted, 0.5 * crown);
        EXPECT_LT(lifted, crown);
        const auto truth = sweep_of(curved);
        const auto road = curved.find_surface("road/body/plane");
        double low = crown, high = 0.0;
        for (std::size_t i = 0; i < truth.scan.size(); ++i) {
            if (truth.surfaces[i] != road) continue;
            low = std::min(low, truth.scan.points[i].z());
            high = std::max(high, truth.scan.points[i].z());
        }
        EXPECT_NEAR(high, crown, 1e-3);
        EXPECT_LT(low, 0.02);
        EXPECT_GE(low, -1e-9);
    }
    for (const double bad : {-0.1, 0.6, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THROW((void)street({.crown = bad}), std::invalid_argument);
}

/// Rays pass through crowns and hedges, and both give returns from their depth.
TEST(street, has_leaves_with_gaps) {
    const auto world = street({.seed = 20'001});
    gnomon::random_stream random(20'007);
    for (const char* kind : {"tree", "hedge"}) {
        std::size_t hits = 0, rays = 0, plants = 0;
        for (const auto& s : world.shapes()) {
            if (world.surfaces()[static_cast<std::size_t>(s.first_surface)].name != "leaves" ||
                !world.surface_name(s.first_surface).starts_with(kind)) {
                continue;
            }
            ++plants;
            const auto& [low, high] = s.extent;
            for (int i = 0; i < 300; ++i) {
                const double x =
                    random.uniform(0.8 * low.x() + 0.2 * high.x(), 0.2 * low.x() + 0.8 * high.x());
                const double z =
                    random.uniform(0.7 * low.z() + 0.3 * high.z(), 0.3 * low.z() + 0.7 * high.z());
                ++rays;
                hits += s.first_hit({{x, low.y() - 1.0, z}, {0, 1, 0}}).has_value();
            }
        }
        EXPECT_GT(plants, 1u);
        EXPECT_GT(hits, rays / 2) << kind;
        EXPECT_LT(hits, rays * 99 / 100) << kind;
    }
}

/// No vehicle is within another, on the pavement or near the sensor in its lane.
TEST(street, keeps_its_vehicles_apart) {
    std::size_t vehicles = 0;
    for (std::uint64_t seed = 20'001; seed <= 20'025; ++seed) {
        const auto world = street({.own_car = true, .seed = seed});
        const auto extents = extents_of(world);
        const sim::bounds road = extents.at("road");
        std::vector<sim::bounds> boxes;
        for (const auto& [name, extent] : extents) {
            if (!is_vehicle(name)) continue;
            EXPECT_GE(extent.low.y(), road.low.y());
            EXPECT_LE(extent.high.y(), road.high.y());
            EXPECT_NEAR(extent.low.z(), 0.0, 1e-9);
            boxes.push_back(extent);
        }
        vehicles += boxes.size();
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const bool apart =
                    boxes[i].low.x() > boxes[j].high.x() || boxes[j].low.x() > boxes[i].high.x() ||
                    boxes[i].low.y() > boxes[j].high.y() || boxes[j].low.y() > boxes[i].high.y();
                EXPECT_TRUE(apart) << seed;
            }
        }
        EXPECT_GE(world.sensor.position.z(), 1.7);
        EXPECT_LE(world.sensor.position.z(), 2.0);
        EXPECT_LT(world.sensor.position.y(), 0.0);
    }
    EXPECT_GT(vehicles, 250u);
}

TEST(street, has_returns_of_its_own_car_if_there_is_one) {
    for (const auto seed : some_seeds) {
        const auto without = street({.seed = seed});
        EXPECT_EQ(points_of_kinds(without, sweep_of(without)).count("own car"), 0u);
        const auto with = street({.own_car = true, .seed = seed});
        const auto lidar = sim::scanners::velodyne_hdl_32e();
        const auto truth = sim::simulate(
            with, sim::fixed{.mount = with.sensor, .duration = lidar.revolution()}, lidar);
        EXPECT_GT(points_of_kinds(with, truth)["own car"], 1000u);
        EXPECT_EQ(with.objects().size(), without.objects().size() + 1);
        // The sensor stands in the middle of the roof.
        const auto below = sim::bvh_caster(with)({with.sensor.position, {0, 0, -1}});
        ASSERT_TRUE(below);
        EXPECT_EQ(with.surface_name(below->surface), "own car/cabin/roof");
    }
}

TEST(street, can_be_short_or_long) {
    EXPECT_LT(street({.length = 20}).objects().size(), street({.length = 300}).objects().size());
    for (const double length : {20.0, 80.0, 160.0}) {
        const sim::bounds road = extents_of(street({.length = length})).at("road");
        EXPECT_NEAR(road.size().x(), length, 1e-9);
    }
    for (const double bad : {19.0, 1001.0, clouds::nan})
        EXPECT_THROW((void)street({.length = bad}), std::invalid_argument);
    for (const double bad : {0.0, -0.12, 0.51, clouds::nan})
        EXPECT_THROW((void)street({.kerb = bad}), std::invalid_argument);
}

}  // namespace
