// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include <gnomon/core.hpp>
#include <gnomon/perception/perceive_views.hpp>
#include <gnomon/simulation.hpp>

namespace rec = gnomon::recognition;
namespace sim = gnomon::simulation;

namespace {

/// Points of a room: a floor of 4 m x 4 m, a wall of 4 m x 2 m at x = 4, and tables of 0.6 m x
/// 0.6 m at these places, each a top of 0.7 m height and a post.
struct room_of_tables {
    gnomon::scan scan;
    std::vector<int> table_of;  // of each point, -1 for none

    explicit room_of_tables(const std::vector<Eigen::Vector2d>& tables, bool has_room = true,
                            const Eigen::Vector3d& origin = {0, 0, 0}) {
        gnomon::random_stream random(4);
        const auto add = [&](int table, double x, double y, double z) {
            const auto noise = [&] { return 0.002 * random.gaussian(); };
            scan.points.push_back(origin + Eigen::Vector3d(x + noise(), y + noise(), z + noise()));
            table_of.push_back(table);
        };
        for (std::size_t t = 0; t < tables.size(); ++t) {
            const double x = tables[t].x(), y = tables[t].y();
            const int number = static_cast<int>(t);
            for (int i = 0; i <= 30; ++i)
                for (int j = 0; j <= 30; ++j)
                    add(number, x + 0.02 * i - 0.3, y + 0.02 * j - 0.3, 0.7);
            for (int k = 0; k < 34; ++k)
                for (int a = 0; a < 6; ++a) add(number, x + 0.01 * a, y, 0.02 * k);
        }
        for (int i = 0; has_room && i < 100; ++i) {
            for (int j = 0; j < 100; ++j) add(-1, 0.04 * i, 0.04 * j - 2.0, 0.0);
            for (int j = 0; j < 50; ++j) add(-1, 4.0, 0.04 * i - 2.0, 0.04 * j);
        }
        scan.viewpoints = Eigen::Vector3d(origin + Eigen::Vector3d(-1.0, 0.0, 1.3));
    }
};

TEST(perceive_views, finds_each_object_of_a_room_without_floor_and_wall) {
    for (const Eigen::Vector3d& origin :
         {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(4e5, 5e6, 500)}) {
        room_of_tables room({{1.0, -1.0}, {2.0, 1.0}, {3.5, -1.0}}, true, origin);
        room.scan.points[7] = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
        const auto seen = rec::perceive_views(room.scan, {.noise = gnomon::constant_noise{0.003}});
        ASSERT_TRUE(seen.ground);
        EXPECT_NEAR(seen.ground->signed_distance(origin), 0.0, 0.01);
        ASSERT_EQ(seen.views.size(), 3u);
        ASSERT_EQ(seen.groups.size(), 3u);
        EXPECT_EQ(seen.groups.labels().size(), room.scan.size());
        ASSERT_EQ(seen.walls.size(), 1u);
        EXPECT_NEAR(seen.walls[0].surface.normal.x(), -1.0, 1e-3);
        EXPECT_NEAR(seen.walls[0].surface.signed_distance(origin + Eigen::Vector3d(4, 1, 1)), 0.0,
                    0.01);
        std::vector<int> tables;
        for (std::size_t v = 0; v < 3; ++v) {
            const int table = room.table_of[seen.groups[v].front()];
            for (const gnomon::point_index i : seen.groups[v]) EXPECT_EQ(room.table_of[i], table);
            EXPECT_GT(seen.groups[v].size(), 31u * 31u);
            tables.push_back(table);
            ASSERT_TRUE(seen.views[v].ground);
            ASSERT_FALSE(seen.views[v].parts.empty());
            const rec::part& top = seen.views[v].parts.front();
            EXPECT_NEAR(top.highest, 0.7, 0.02);
            // Its points are those of the segment, on the same table.
            for (const gnomon::point_index i : seen.parts[static_cast<std::size_t>(top.segment)])
                EXPECT_EQ(room.table_of[i], table);
        }
        std::sort(tables.begin(), tables.end());
        EXPECT_EQ(tables, (std::vector<int>{0, 1, 2}));
    }
}

TEST(perceive_views, gap_decides_what_is_one_object) {
    const room_of_tables room({{1.0, 0.0}, {1.0, 0.66}});  // 6 cm apart
    EXPECT_EQ(rec::perceive_views(room.scan).views.size(), 1u);
    EXPECT_EQ(rec::perceive_views(room.scan, {.gap = 0.04}).views.size(), 2u);
}

TEST(perceive_views, a_single_object_has_one_view_however_wide_its_gaps) {
    const room_of_tables alone({{1.0, 0.0}, {1.0, 1.5}}, false);
    const auto seen =
        rec::perceive_views(alone.scan, {.ground = gnomon::plane{}, .gap = rec::infinite_gap});
    ASSERT_EQ(seen.views.size(), 1u);
    EXPECT_GE(seen.views[0].parts.size(), 2u);
    EXPECT_EQ(seen.views[0].ground->offset, 0.0);
}

TEST(perceive_views, a_view_of_a_room_is_that_of_the_object_alone) {
    const room_of_tables room({{1.5, 0.5}}), alone({{1.5, 0.5}}, false);
    const rec::perceive_views_options how{.noise = gnomon::constant_noise{0.003}};
    auto single = how;
    single.ground = gnomon::plane{};
    single.gap = rec::infinite_gap;
    const auto a = rec::perceive_views(room.scan, how), b = rec::perceive_views(alone.scan, single);
    ASSERT_EQ(a.views.size(), 1u);
    ASSERT_EQ(b.views.size(), 1u);
    ASSERT_EQ(a.views[0].parts.size(), b.views[0].parts.size());
    for (std::size_t p = 0; p < a.views[0].parts.size(); ++p) {
        const auto &x = a.views[0].parts[p].shape, &y = b.views[0].parts[p].shape;
        EXPECT_LT((x.frame.centroid - y.frame.centroid).norm(), 0.02);
        EXPECT_LT((x.frame.box_size - y.frame.box_size).norm(), 0.05);
    }
}

TEST(perceive_views, does_not_depend_on_the_number_of_threads) {
    const room_of_tables room({{1.0, -1.0}, {2.0, 1.0}});
    const auto a = rec::perceive_views(room.scan),
               b = rec::perceive_views(room.scan, {}, gnomon::threads{3});
    EXPECT_EQ(a.groups, b.groups);
    EXPECT_EQ(a.parts, b.parts);
    ASSERT_EQ(a.views.size(), b.views.size());
    for (std::size_t v = 0; v < a.views.size(); ++v)
        EXPECT_EQ(a.views[v].parts.front().shape.frame.centroid,
                  b.views[v].parts.front().shape.frame.centroid);
}

TEST(perceive_views, degenerate_scans_have_no_views) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const std::size_t n : {0u, 1u, 3u, 200u}) {
        for (const double x : {nan, 1.0}) {
            const std::vector<Eigen::Vector3d> points(n, Eigen::Vector3d(x, 1.0, 1.0));
            for (const double gap : {0.1, rec::infinite_gap}) {
                const auto seen = rec::perceive_views(points, {.gap = gap});
                EXPECT_TRUE(seen.views.empty());
                EXPECT_EQ(seen.groups.labels().size(), n);
                EXPECT_EQ(seen.parts.labels().size(), n);
            }
        }
    }
    // Without a floor objects are found, but have no ground.
    const room_of_tables alone({{1.0, 0.0}}, false);
    const auto seen = rec::perceive_views(alone.scan);
    EXPECT_FALSE(seen.ground);
    ASSERT_EQ(seen.views.size(), 1u);
    EXPECT_FALSE(seen.views[0].ground);
}

/// Beams that hit a stool and the carton behind it return a chain of points from one to the other.
TEST(perceive_views, wide_beams_connect_no_objects_if_their_width_is_known) {
    const gnomon::angle full_angle = gnomon::radians(0.010);
    sim::scene world;
    world.add_object("floor", sim::plane_patch{.length = 6.0, .width = 6.0}, sim::at(2, 0, 0));
    world.add_object("post", sim::box{0.1, 0.3, 0.8}, sim::at(2.0, 0.0, 0.4));
    world.add_object("carton", sim::box{0.3, 0.9, 0.9}, sim::at(2.55, 0.0, 0.45));
    for (const double sigma : {0.005, 0.010}) {
        const auto truth = sim::simulate(
            world, sim::vertical{.mount = sim::at(0.0, 0.0, 1.2), .duration = 4.0}, sim::scanner{},
            {.sigma = sigma,
             .footprint = {
                 .divergence = full_angle, .sub_rays = 9, .rule = sim::echo_rule::averaged}});
        // Views with more points of both than those at its edges.
        const auto connected = [&](gnomon::angle divergence) {
            const auto seen = rec::perceive_views(truth.scan, {.divergence = divergence});
            EXPECT_GE(seen.views.size(), 2u);  // the post hides the middle of the carton
            int of_both = 0;
            for (std::size_t g = 0; g < seen.groups.size(); ++g) {
                const auto of = [&](std::int32_t object) {
                    return std::ranges::count(seen.groups[g], object, [&](gnomon::point_index i) {
                        return truth.objects[i];
                    });
                };
                of_both += 10 * std::min(of(1), of(2)) > std::max(of(1), of(2));
            }
            return of_both;
        };
        EXPECT_GE(connected(gnomon::degrees(0.0)), 1) << sigma;
        EXPECT_EQ(connected(full_angle), 0) << sigma;
    }
}

TEST(perceive_views, options_out_of_range_are_refused) {
    const std::vector<Eigen::Vector3d> points(100, Eigen::Vector3d(1, 2, 3));
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (const rec::perceive_views_options& wrong : {rec::perceive_views_options{.gap = -1.0},
                                                     {.gap = nan},
                                                     {.cell = 0.0},
                                                     {.cell = nan},
                                                     {.k = 2},
                                                     {.reach = 0.0},
                                                     {.reach = nan},
                                                     {.max_length = -1.0},
                                                     {.max_length = nan},
                                                     {.up = Eigen::Vector3d(0, 0, 2)},
                                                     {.ground = gnomon::plane{{0, 0, 2}, 0.0}}})
        EXPECT_THROW(static_cast<void>(rec::perceive_views(points, wrong)), std::invalid_argument);
}

}  // namespace
