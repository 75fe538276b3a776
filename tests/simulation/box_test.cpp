// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/box.hpp>
#include <gnomon/simulation/bvh_caster.hpp>
#include <gnomon/simulation/pose.hpp>
#include <gnomon/simulation/scene.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::shape<sim::box>);
const sim::box chest{0.4, 0.3, 1.2};

TEST(box, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(chest, 1), 1000u); }

TEST(box, agrees_with_its_equation) {
    EXPECT_GT(
        laws::agrees_with_equation(
            chest, 2,
            [](auto x, auto y, auto z) {
                return std::max({std::abs(x) - 0.2L, std::abs(y) - 0.15L, std::abs(z) - 0.6L});
            }),
        1000u);
}

TEST(box, numbers_its_sides) {
    for (int side = 0; side < 6; ++side) {
        Eigen::Vector3d outwards(0, 0, 0);
        outwards[side / 2] = side % 2 == 0 ? 1.0 : -1.0;
        const auto from_outside = chest.first_hit({3.0 * outwards, -outwards});
        ASSERT_TRUE(from_outside);
        EXPECT_EQ(from_outside->surface, side);
        EXPECT_EQ(from_outside->normal, outwards);
        const auto from_inside = chest.first_hit({{0, 0, 0}, outwards});
        ASSERT_TRUE(from_inside);
        EXPECT_EQ(from_inside->surface, side);
        EXPECT_EQ(from_inside->normal, -outwards);
    }
}

TEST(box, can_be_flat) {
    const sim::box plate{1.0, 1.0, 0.0};
    const auto hit = plate.first_hit({{0.1, 0.2, 2.0}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->range, 2.0);
    EXPECT_FALSE(plate.first_hit({{-3, 0, 0.1}, {1, 0, 0}}));
}

/// Boxes in a row that touch: no ray falls between them, wherever they stand.
TEST(box, leaves_no_seam_to_a_box_that_touches_it) {
    for (const double yaw : {0.0, 17.3}) {
        for (const double offset : {0.0, 1.7, 5e6}) {
            sim::scene row;
            const auto part = row.add_part(row.add_object("row"), "row");
            const sim::pose base =
                sim::at(offset, 1.1 * offset, 0.3) * sim::yaw(gnomon::degrees(yaw));
            for (int i = 0; i < 10; ++i)
                row.add(part, sim::box{0.1, 0.5, 0.5}, base * sim::at(0.1 * i, 0, 0));
            const sim::bvh_caster caster(row);
            gnomon::random_stream random(3);
            for (int i = 0; i < 2000; ++i) {
                const double seam = 0.05 + 0.1 * static_cast<double>(random.below(9));
                const Eigen::Vector3d to(seam, random.uniform(-0.2, 0.2), 0.25);
                const double aside = i % 2 ? 0.0 : random.uniform(-0.5, 0.5);
                const Eigen::Vector3d from(seam, to.y() + aside, 2.25);
                const Eigen::Vector3d u = base.point_out(to) - base.point_out(from);
                const auto hit = caster({base.point_out(from), u.normalized()});
                ASSERT_TRUE(hit) << "yaw " << yaw << ", offset " << offset;
                EXPECT_NEAR(hit->range, u.norm(), 1e-8);
            }
        }
    }
}

}  // namespace
