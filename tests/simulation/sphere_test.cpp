// SPDX-License-Identifier: BSL-1.0
#include <cmath>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/simulation/sphere.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::shape<sim::sphere>);
const sim::sphere ball{0.7};

TEST(sphere, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(ball, 1), 1000u); }

TEST(sphere, agrees_with_its_equation) {
    EXPECT_GT(laws::agrees_with_equation(ball, 2,
                                         [](auto x, auto y, auto z) {
                                             return std::sqrt(x * x + y * y + z * z) -
                                                    (long double)(0.7);
                                         }),
              1000u);
}

TEST(sphere, has_normals_through_its_center) {
    for (const sim::ray& r : laws::rays_at(ball.extent(), 500, 3)) {
        const auto hit = ball.first_hit(r);
        if (!hit) continue;
        const Eigen::Vector3d p = r.point_at(hit->range);
        EXPECT_LT((hit->normal.cross(Eigen::Vector3d(p / 0.7))).norm(), 1e-12 * (1 + hit->range));
    }
}

}  // namespace
