// SPDX-License-Identifier: BSL-1.0
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/detail/room_layout.hpp>
#include <gnomon/simulation/detail/upright_box.hpp>

namespace sim = gnomon::simulation;
namespace d = gnomon::simulation::detail;

namespace {

d::floor_place some_place(gnomon::random_stream& random, double reach) {
    return {random.uniform(-reach, reach), random.uniform(-reach, reach),
            gnomon::degrees(random.uniform(-180, 180))};
}

sim::bounds some_bounds(gnomon::random_stream& random) {
    return {{random.uniform(-0.5, -0.1), random.uniform(-0.8, -0.1), 0.0},
            {random.uniform(0.1, 0.5), random.uniform(0.1, 0.8), random.uniform(0.2, 1.0)}};
}

/// Points on a grid in a placed rectangle.
std::vector<Eigen::Vector2d> grid_in(const sim::bounds& own, const d::floor_place& place, int n) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            const Eigen::Vector3d p(own.low.x() + i * own.size().x() / n,
                                    own.low.y() + j * own.size().y() / n, 0.0);
            points.push_back(place.pose().point_out(p).head<2>());
        }
    }
    return points;
}

/// The distance is that of the nearest points of two grids, by brute force.
TEST(upright_box, has_the_distance_of_its_nearest_points) {
    gnomon::random_stream random(1);
    int apart = 0, overlapping = 0;
    for (int pair = 0; pair < 100; ++pair) {
        const auto own_a = some_bounds(random), own_b = some_bounds(random);
        const auto at_a = some_place(random, 0.8), at_b = some_place(random, 0.8);
        const double found = distance(d::upright_box(own_a, at_a), d::upright_box(own_b, at_b));
        EXPECT_EQ(found, distance(d::upright_box(own_b, at_b), d::upright_box(own_a, at_a)));
        constexpr int n = 16;
        double brute = 10.0;
        for (const auto& p : grid_in(own_a, at_a, n))
            for (const auto& q : grid_in(own_b, at_b, n)) brute = std::min(brute, (p - q).norm());
        const double mesh = 1.6 / n;  // of a grid, at most
        EXPECT_LE(found, brute + 1e-12);
        EXPECT_GE(found, brute - 1.5 * mesh);
        (found > 0.0 ? apart : overlapping) += 1;
    }
    EXPECT_GT(apart, 15);
    EXPECT_GT(overlapping, 15);
}

/// Crossed boxes overlap though no corner of one is in the other; boxes above each other are apart.
TEST(upright_box, overlaps_where_it_should) {
    const sim::bounds along{{-1, -0.1, 0}, {1, 0.1, 0.5}}, across{{-0.1, -1, 0.2}, {0.1, 1, 0.8}},
        above{{-1, -1, 0.51}, {1, 1, 0.8}};
    EXPECT_EQ(distance(d::upright_box(along, {}), d::upright_box(across, {})), 0.0);
    EXPECT_EQ(distance(d::upright_box(along, {}), d::upright_box(above, {})),
              std::numeric_limits<double>::infinity());
}

/// What is moved towards a piece stops at the gap: a low box passes below a table top, up to its
/// leg; what is aside passes by.
TEST(upright_box, moves_up_to_other_pieces) {
    const d::own_boxes table{{{-0.5, -0.5, 0.7}, {0.5, 0.5, 0.75}},
                             {{0.1, -0.05, 0}, {0.2, 0.05, 0.7}}};
    const d::own_boxes low{{{-0.1, -0.1, 0}, {0.1, 0.1, 0.4}}},
        high{{{-0.1, -0.1, 0}, {0.1, 0.1, 0.9}}};
    const d::standing_piece other(table, {1.0, 2.0, gnomon::degrees(90)});
    const auto x = gnomon::degrees(0), y = gnomon::degrees(90);
    const auto stop = [&](const d::own_boxes& own, double aside) {
        return d::beside(other, own, x, y, aside, 0.002);
    };
    ASSERT_TRUE(stop(high, 0.0) && stop(low, 0.0));
    EXPECT_NEAR(stop(high, 0.0)->y, 2.0 + 0.5 + 0.1 + 0.002, 2e-4);
    EXPECT_NEAR(stop(low, 0.0)->y, 2.0 + 0.2 + 0.1 + 0.002, 2e-4);
    EXPECT_NEAR(stop(low, 0.0)->x, 1.0, 1e-12);
    EXPECT_FALSE(stop(low, 0.3));
    EXPECT_GE(distance(other.boxes, d::placed(high, *stop(high, 0.3))), 0.002);
}

}  // namespace
