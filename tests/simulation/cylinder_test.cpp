// SPDX-License-Identifier: BSL-1.0
#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "laws/shape_laws.hpp"
#include <gnomon/core/random.hpp>
#include <gnomon/simulation/cylinder.hpp>

namespace sim = gnomon::simulation;

namespace {

static_assert(sim::shape<sim::cylinder>);
const sim::cylinder bin{0.3, 0.9};

TEST(cylinder, obeys_the_laws) { EXPECT_GT(laws::obeys_shape_laws(bin, 1), 1000u); }

TEST(cylinder, agrees_with_its_equation) {
    EXPECT_GT(laws::agrees_with_equation(bin, 2,
                                         [](auto x, auto y, auto z) {
                                             return std::max(std::sqrt(x * x + y * y) - 0.3L,
                                                             std::abs(z - 0.45L) - 0.45L);
                                         }),
              1000u);
}

TEST(cylinder, numbers_mantle_bottom_and_top) {
    EXPECT_EQ(bin.first_hit({{2, 0, 0.5}, {-1, 0, 0}})->surface, 0);
    EXPECT_EQ(bin.first_hit({{0.1, 0, -1}, {0, 0, 1}})->surface, 1);
    EXPECT_EQ(bin.first_hit({{0.1, 0, 3}, {0, 0, -1}})->surface, 2);
}

/// A ray that leaves the surface does not meet it in the same place, whatever rounding says.
TEST(cylinder, does_not_occlude_objects_on_it) {
    const sim::cylinder c{0.5, 0.3};
    gnomon::random_stream random(4);
    for (const auto& [on, out] :
         {std::pair{Eigen::Vector3d(0.1, 0.2, 0.3), Eigen::Vector3d(0, 0, 1)},
          {Eigen::Vector3d(0.3, 0.4, 0.1), Eigen::Vector3d(0.6, 0.8, 0)}}) {
        for (int i = 0; i < 5000; ++i) {
            const Eigen::Vector3d u = laws::random_direction(random);
            if (u.dot(out) > 0.05) {
                EXPECT_FALSE(c.first_hit({on, u}));
            }
        }
    }
}

}  // namespace
