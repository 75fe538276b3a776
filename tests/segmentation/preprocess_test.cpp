// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "laws/clouds.hpp"
#include <gnomon/core/angle.hpp>
#include <gnomon/filters/crop_height.hpp>
#include <gnomon/segmentation/leveling.hpp>
#include <gnomon/segmentation/preprocess.hpp>
#include <gnomon/simulation/furniture.hpp>
#include <gnomon/simulation/simulate.hpp>

namespace {

namespace sim = gnomon::simulation;

/// A furnished room, 4 x 4 x 2.5 m, and what each point lies on.
struct room {
    enum part : char { floor, ceiling, other };
    clouds::cloud points;
    std::vector<part> parts;
};

room furnished_room(std::uint64_t seed) {
    gnomon::random_stream random(seed);
    room r;
    const auto put = [&](double x, double y, double z, room::part part) {
        const double sigma = 0.005;
        r.points.push_back({x + sigma * random.gaussian(), y + sigma * random.gaussian(),
                            z + sigma * random.gaussian()});
        r.parts.push_back(part);
    };
    for (int i = 0; i < 12'000; ++i) {
        const double u = random.uniform(0.0, 4.0);
        const double v = random.uniform(0.0, 4.0);
        if (i % 3 == 0) put(u, v, 0.0, room::floor);
        if (i % 3 == 1) put(u, v, 2.5, room::ceiling);
        // Walls from 10 cm up, so that what is true of a point is beyond doubt, a table, its legs.
        const double h = random.uniform(0.1, 2.4);
        if (i % 6 == 2) put(0.0, v, h, room::other);
        if (i % 6 == 5) put(u, 4.0, h, room::other);
        if (i % 8 == 0) put(1.0 + 0.25 * u, 1.0 + 0.25 * v, 0.74, room::other);
        if (i % 60 == 0) put(1.0, 1.0, random.uniform(0.1, 0.74), room::other);
    }
    return r;
}

/// Rotation by `tilt` about a horizontal axis at `heading`.
Eigen::Matrix3d tilted(gnomon::angle tilt, double heading) {
    const Eigen::Vector3d a(std::cos(heading), std::sin(heading), 0.0);
    Eigen::Matrix3d k;
    k << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
    return Eigen::Matrix3d::Identity() + sin(tilt) * k + (1 - cos(tilt)) * k * k;
}

/// The acceptance of Sec. 4.2.2: tilt within 0.05 degrees, ceiling within 1 cm, 99 % of floor and
/// ceiling removed, at most 1 % of the rest lost.
TEST(preprocess, sets_a_tilted_room_upright_and_removes_floor_and_ceiling) {
    const room truth = furnished_room(1);
    for (const double tilt : {0.0, 1.0, 2.0, 3.0}) {
        for (const double heading : {0.0, 1.0, 2.5, 4.0}) {
            SCOPED_TRACE(tilt);
            const Eigen::Matrix3d r = tilted(gnomon::degrees(tilt), heading);
            const auto points = clouds::moved(truth.points, r, {0, 0, 0.02});
            const auto floor = gnomon::find_floor(points);
            ASSERT_TRUE(floor);
            const double error = std::acos(std::min(1.0, floor->normal.dot(r.col(2))));
            EXPECT_LT(gnomon::radians(error), gnomon::degrees(0.05));

            const auto ceiling = gnomon::find_ceiling(points, *floor);
            ASSERT_TRUE(ceiling);
            EXPECT_NEAR(*ceiling, 2.5, 0.01);

            const auto kept = gnomon::crop_height(points, *floor, ceiling);
            std::vector<bool> is_kept(points.size(), false);
            for (const auto i : kept) is_kept[i] = true;
            double bands = 0, removed = 0, others = 0, lost = 0;
            for (std::size_t i = 0; i < points.size(); ++i) {
                const bool other = truth.parts[i] == room::other;
                (other ? others : bands) += 1;
                if (!is_kept[i]) (other ? lost : removed) += 1;
            }
            EXPECT_GE(removed, 0.99 * bands);
            EXPECT_LE(lost, 0.01 * others);

            const auto level = gnomon::leveling::of(*floor);
            for (std::size_t i = 0; i < points.size(); i += 101) {
                EXPECT_NEAR(level(points[i]).z(), truth.points[i].z(), 0.01);
            }
        }
    }
}

/// A carpet of clutter, five centimetres high on one side of the room, does not tilt the floor.
TEST(preprocess, floor_is_not_biased_by_objects_on_it) {
    gnomon::random_stream random(5);
    clouds::cloud points;
    for (int i = 0; i < 6000; ++i) {
        const double x = random.uniform(0.0, 4.0);
        const double y = random.uniform(0.0, 4.0);
        points.push_back({x, y, 0.002 * random.gaussian()});
        if (i % 4 == 0) points.push_back({0.25 * x, y, random.uniform(0.03, 0.07)});
    }
    const auto floor = gnomon::find_floor(points);
    ASSERT_TRUE(floor);
    EXPECT_LT(std::acos(floor->normal.z()), gnomon::degrees(0.05).radians());
    EXPECT_NEAR(floor->offset, 0.0, 0.002);
}

/// UTM coordinates and outliers far below and above do not change floor and ceiling.
TEST(preprocess, finds_floor_and_ceiling_at_utm_coordinates_and_among_outliers) {
    const room truth = furnished_room(3);
    const Eigen::Matrix3d r = tilted(gnomon::degrees(1.5), 0.7);
    auto points = clouds::moved(truth.points, r, {6e5, 4.8e6, 100});
    for (const double z : {-1e6, -500.0, 400.0, 1e9}) points.push_back({6e5, 4.8e6, z});
    const auto floor = gnomon::find_floor(points, Eigen::Vector3d::UnitZ(), {.band = 0.2});
    ASSERT_TRUE(floor);
    const double error = std::acos(std::min(1.0, floor->normal.dot(r.col(2))));
    EXPECT_LT(gnomon::radians(error), gnomon::degrees(0.05));
    const auto ceiling = gnomon::find_ceiling(points, *floor);
    ASSERT_TRUE(ceiling);
    EXPECT_NEAR(*ceiling, 2.5, 0.01);
}

TEST(preprocess, finds_a_floor_that_is_not_at_zero) {
    const room truth = furnished_room(2);
    const auto sunk = clouds::moved(truth.points, Eigen::Matrix3d::Identity(), {0, 0, -1.2});
    const auto floor = gnomon::find_floor(sunk);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->offset, -1.2, 0.002);
}

/// In a small cloud a single outlier is more than 0.1 % of the points.
TEST(preprocess, finds_the_floor_of_a_small_cloud_with_outliers) {
    gnomon::random_stream random(4);
    clouds::cloud points;
    for (int i = 0; i < 200; ++i)
        points.push_back({random.uniform(0.0, 3.0), random.uniform(0.0, 3.0), 0.0});
    for (const double z : {-1e9, 1e9, -1e140}) points.push_back({0.0, 0.0, z});
    const auto floor = gnomon::find_floor(points);
    ASSERT_TRUE(floor);
    EXPECT_NEAR(floor->offset, 0.0, 1e-9);
    for (const Eigen::Vector3d& bad :
         {Eigen::Vector3d(clouds::nan, 1, 0), Eigen::Vector3d(0, clouds::infinity, 0),
          Eigen::Vector3d(1e200, 0, 0)})
        points.push_back(bad);
    EXPECT_EQ(gnomon::find_floor(points).value().offset, floor->offset);
}

/// What the sensor sees of furniture from above its table tops and seats, with nothing else.
TEST(preprocess, finds_no_floor_in_furniture_alone) {
    for (const sim::furniture_model& model : sim::furniture_models()) {
        sim::scene world;
        add(world, model);
        for (int view = 0; view < 6; ++view) {
            SCOPED_TRACE(model.name + ", view " + std::to_string(view));
            const sim::pose sensor = sim::yaw(gnomon::degrees(70.0 * view + 10.0)) *
                                     sim::at(-1.4, 0.0, 0.5 + 0.4 * view) *
                                     sim::pitch(gnomon::degrees(15.0 * view));
            const gnomon::scan scan =
                sim::simulate(world, sim::rotational{.mount = sensor, .duration = 2.0}, {},
                              {.sigma = 0.015, .seed = 7})
                    .scan;
            EXPECT_FALSE(gnomon::find_floor(scan));
        }
    }
}

/// A table top alone, 2.4 x 1.2 m, is level and has nothing below it, but is not as wide as a
/// floor; twice as wide it is taken for one, unless the sensor is below it.
TEST(preprocess, finds_no_floor_in_a_table_top_alone) {
    gnomon::random_stream random(6);
    clouds::cloud top, wide;
    for (int i = 0; i < 9000; ++i) {
        const Eigen::Vector3d p(random.uniform(0.0, 2.4), random.uniform(0.0, 1.2),
                                0.74 + 0.005 * random.gaussian());
        top.push_back(p);
        wide.push_back({p.x(), 2.0 * p.y(), p.z()});
    }
    EXPECT_FALSE(gnomon::find_floor(top));
    EXPECT_TRUE(gnomon::find_floor(wide));
    EXPECT_FALSE(gnomon::find_floor(wide, Eigen::Vector3d::UnitZ(), {.min_width = 3.0}));
    EXPECT_TRUE(gnomon::find_floor(gnomon::with_viewpoint(wide, Eigen::Vector3d(0, 0, 1.5))));
    EXPECT_FALSE(gnomon::find_floor(gnomon::with_viewpoint(wide, Eigen::Vector3d(0, 0, 0.2))));

    // Legs below it, a twentieth of its points.
    for (int i = 0; i < 450; ++i) wide.push_back({0.1, 0.1, random.uniform(0.1, 0.6)});
    EXPECT_FALSE(gnomon::find_floor(wide));
}

/// A wall, and a room of which only walls are seen.
TEST(preprocess, finds_no_floor_in_walls) {
    gnomon::random_stream random(8);
    clouds::cloud wall;
    for (int i = 0; i < 8000; ++i)
        wall.push_back(
            {random.uniform(0.0, 5.0), 0.005 * random.gaussian(), random.uniform(0.5, 2.0)});
    EXPECT_FALSE(gnomon::find_floor(wall));
    for (std::size_t i = 0; i < 8000; ++i) wall.push_back({0.0, wall[i].x(), wall[i].z()});
    EXPECT_FALSE(gnomon::find_floor(wall));
}

TEST(preprocess, floor_moves_with_the_points) {
    const room truth = furnished_room(9);
    const auto floor = gnomon::find_floor(truth.points);
    ASSERT_TRUE(floor);
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
        const Eigen::Matrix3d r = clouds::random_rotation(seed);
        const Eigen::Vector3d t = 3.0 * r.col(seed % 3);
        const auto moved = gnomon::find_floor(clouds::moved(truth.points, r, t), r.col(2));
        ASSERT_TRUE(moved);
        EXPECT_LT((moved->normal - r * floor->normal).norm(), 1e-4);
        EXPECT_NEAR(moved->offset, floor->offset + moved->normal.dot(t), 5e-4);
    }
}

TEST(preprocess, finds_nothing_in_empty_input) {
    EXPECT_FALSE(gnomon::find_floor(clouds::cloud{}));
    EXPECT_FALSE(gnomon::find_floor(clouds::cloud(50, {0, 0, 0})));
    EXPECT_FALSE(gnomon::find_floor(clouds::cloud(50, {0, 0, 7})));
    EXPECT_FALSE(gnomon::find_ceiling(clouds::sheet(100, 1), gnomon::plane{}));
    for (const auto& [name, points] : clouds::degenerate()) {
        SCOPED_TRACE(name);
        const auto floor = gnomon::find_floor(points);
        EXPECT_TRUE(!floor || (floor->normal.allFinite() && std::isfinite(floor->offset)));
        (void)gnomon::find_ceiling(points, floor.value_or(gnomon::plane{}));
    }
}

/// Neither bins that reach below the least height nor outliers, whose bins are of rounding errors.
TEST(preprocess, finds_no_ceiling_below_the_least_height) {
    const clouds::cloud points{{0, 0, 0.1}, {0, 0, 0.2}, {0, 0, 2.1}, {0, 0, 2.2}};
    for (const double bin : {0.02, 1.0, 1e6}) {
        const auto ceiling = gnomon::find_ceiling(points, gnomon::plane{}, {.bin = bin});
        ASSERT_TRUE(ceiling) << bin;
        EXPECT_GE(*ceiling, 1.8) << bin;
        EXPECT_LE(*ceiling, 2.2) << bin;
    }
    EXPECT_EQ(gnomon::find_ceiling(clouds::cloud{{0, 0, 1e140}}, gnomon::plane{}), 1e140);
}

TEST(preprocess, refuses_bands_without_width) {
    const auto points = clouds::sheet(100, 1);
    const Eigen::Vector3d up(0, 0, 1);
    for (const double bad : {0.0, -1.0, clouds::nan}) {
        EXPECT_THROW((void)gnomon::find_floor(points, up, {.band = bad}), std::invalid_argument);
        EXPECT_THROW((void)gnomon::find_floor(points, up, {.min_width = bad}),
                     std::invalid_argument);
    }
    for (const Eigen::Vector3d& bad :
         {Eigen::Vector3d(0, 0, 2), Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, clouds::nan)}) {
        EXPECT_THROW((void)gnomon::find_floor(points, bad), std::invalid_argument);
        EXPECT_THROW((void)gnomon::find_ceiling(points, {bad, 0.0}), std::invalid_argument);
    }
    for (const double bad : {0.0, 1e-310, 1e300, clouds::nan})
        EXPECT_THROW((void)gnomon::find_ceiling(points, gnomon::plane{}, {.bin = bad}),
                     std::invalid_argument)
            << bad;
    EXPECT_THROW((void)gnomon::find_ceiling(points, gnomon::plane{}, {.min_height = clouds::nan}),
                 std::invalid_argument);
    EXPECT_THROW((void)gnomon::find_ceiling(points, gnomon::plane{}, {.min_share = clouds::nan}),
                 std::invalid_argument);
}

}  // namespace
