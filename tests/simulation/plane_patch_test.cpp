// SPDX-License-Identifier: BSL-1.0
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/plane_patch.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::shape<sim::plane_patch>);
const sim::plane_patch sheet{0.4, 0.3};

TEST(plane_patch, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(sheet, 1), 100u); }

TEST(plane_patch, ends_where_it_ends) {
    EXPECT_TRUE(sheet.first_hit({{0.2, 0.15, 1}, {0, 0, -1}}));
    EXPECT_FALSE(sheet.first_hit({{0.2001, 0.0, 1}, {0, 0, -1}}));
    EXPECT_FALSE(sheet.first_hit({{0.0, 0.1501, 1}, {0, 0, -1}}));
}

TEST(plane_patch, is_seen_from_both_sides_and_not_from_the_edge) {
    EXPECT_EQ(sheet.first_hit({{0, 0, 1}, {0, 0, -1}})->normal, Eigen::Vector3d(0, 0, 1));
    EXPECT_EQ(sheet.first_hit({{0, 0, -1}, {0, 0, 1}})->normal, Eigen::Vector3d(0, 0, -1));
    EXPECT_FALSE(sheet.first_hit({{-3, 0, 0}, {1, 0, 0}}));
    EXPECT_FALSE(sheet.first_hit({{0, 0, 1}, {0, 0, 1}}));
}

/// A room of six walls is closed at its edges and in its corners, wherever it stands.
TEST(plane_patch, leaves_no_gap_to_a_wall_that_touches_it) {
    using gnomon::degrees;
    using sim::at;
    const sim::pose facing_y = sim::roll(degrees(90));
    const sim::pose facing_x = sim::yaw(degrees(90)) * facing_y;
    for (const double yaw : {0.0, 17.3, 45.0}) {
        for (const double offset : {0.0, 0.1, 123.456, 1e3, 5e6}) {
            const sim::pose base = at(offset, 1.1 * offset, 0.3) * sim::yaw(degrees(yaw));
            sim::scene room;
            const auto part = room.add_part(room.add_object("room"), "walls");
            const auto add = [&](double width, const sim::pose& place) {
                room.add(part, sim::plane_patch{4, width}, base * place);
            };
            add(4, at(0, 0, -1));
            add(4, at(0, 0, 1));
            add(2, at(0, -2, 0) * facing_y);
            add(2, at(0, 2, 0) * facing_y);
            add(2, at(-2, 0, 0) * facing_x);
            add(2, at(2, 0, 0) * facing_x);
            const sim::bvh_caster caster(room);
            gnomon::random_stream random(1);
            for (int i = 0; i < 5000; ++i) {
                const double s = i % 10 ? random.uniform(-1.0, 1.0) : 1.0;
                const double a = random.below(2) ? 1.0 : -1.0;
                const double b = random.below(2) ? 1.0 : -1.0;
                const Eigen::Vector3d to = i % 3 == 0   ? Eigen::Vector3d(2 * a, 2 * b, s)
                                           : i % 3 == 1 ? Eigen::Vector3d(2 * a, 2 * s, b)
                                                        : Eigen::Vector3d(2 * s, 2 * a, b);
                Eigen::Vector3d from(0, 0, 0);
                if (i % 7)
                    from = {random.uniform(-1, 1), random.uniform(-1, 1),
                            random.uniform(-0.5, 0.5)};
                const Eigen::Vector3d u = base.point_out(to) - base.point_out(from);
                ASSERT_TRUE(caster({base.point_out(from), u.normalized()}))
                    << "yaw " << yaw << ", offset " << offset;
            }
        }
    }
}

}  // namespace
